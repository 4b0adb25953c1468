#include "sdk/cycle_client.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "gsv/exchange/content.h"
#include "sdk/fault_delay.h"

namespace gsv::sdk {
namespace {

using exchange::CycleState;
using exchange::StateOf;
using exchange::WithState;
using Clock = std::chrono::steady_clock;

bool IsPending(CycleState state) {
  return state == CycleState::kPosted || state == CycleState::kTaken;
}

void ReadReading(exchange::ContentReader& content, Reading& reading) {
  reading.sensor = content.TakeText();
  reading.time = SimTime(content.Take<std::int64_t>());
  const auto values = content.TakeValues();
  reading.values.assign(values.begin(), values.end());
  reading.labels.clear();
  const auto labels = content.Take<std::uint64_t>();
  for (std::uint64_t i = 0; i < labels && content.ok(); ++i) {
    reading.labels.emplace_back(content.TakeText());
  }
}

}  // namespace

base::Result<std::unique_ptr<CycleClient>> CycleClient::Open(const exchange::FileAddress& address,
                                                             std::uint64_t offset,
                                                             std::uint64_t key) {
  const auto file = exchange::SharedFile::Open(address);
  if (!file) return base::Fail(file.error());
  const auto size = (*file)->size();
  if (!size) return base::Fail(size.error());
  if (offset < exchange::kSlotSize || offset % exchange::kSlotSize != 0 ||
      offset > *size - exchange::kSlotSize || *size < 2 * exchange::kSlotSize) {
    return base::Fail(base::ErrorCode::kUnavailable, "the shared memory is too small");
  }
  auto bell = (*file)->Map(0, sizeof(exchange::Bell));
  if (!bell) return base::Fail(bell.error());
  auto slot = (*file)->Map(offset, exchange::kSlotSize);
  if (!slot) return base::Fail(slot.error());
  std::unique_ptr<CycleClient> client(new CycleClient(*std::move(bell), *std::move(slot)));
  std::uint32_t state = static_cast<std::uint32_t>(CycleState::kNew);
  if (client->bell_.key != key || !client->slot_.state.compare_exchange_strong(
                                      state, static_cast<std::uint32_t>(CycleState::kIdle))) {
    return base::Fail(base::ErrorCode::kUnavailable, "the memory is that of another simulation");
  }
  return client;
}

CycleClient::CycleClient(std::unique_ptr<exchange::Mapping> bell,
                         std::unique_ptr<exchange::Mapping> slot)
    : bell_memory_(std::move(bell)),
      slot_memory_(std::move(slot)),
      bell_(*static_cast<exchange::Bell*>(bell_memory_->data())),
      slot_(*static_cast<exchange::CycleSlot*>(slot_memory_->data())) {}

CycleClient::Outcome CycleClient::Run(exchange::CycleRequest request,
                                      const std::vector<std::string>& sensors, Answer& answer) {
  DelayOnce();
  if (!Post(request, sensors)) return Outcome::kRepeat;
  bool is_answered = Await() == CycleState::kAnswered;
  if (is_answered) is_answered = Read(answer);
  const bool is_applied = slot_.is_applied != 0;
  std::uint32_t state = slot_.state;
  // the slot may have been closed meanwhile
  while (StateOf(state) != CycleState::kClosed &&
         !slot_.state.compare_exchange_weak(state, WithState(state, CycleState::kIdle))) {
  }
  if (is_answered) {
    DelayOnce();
    return Outcome::kAnswered;
  }
  return is_applied ? Outcome::kRepeatApplied : Outcome::kRepeat;
}

bool CycleClient::Post(exchange::CycleRequest request, const std::vector<std::string>& sensors) {
  std::uint32_t state = slot_.state;
  if (StateOf(state) != CycleState::kIdle) return false;
  exchange::ContentWriter content(slot_.content);
  content.Add(std::uint64_t{sensors.size()});
  for (const std::string& sensor : sensors) content.Add(std::string_view(sensor));
  if (!content.ok()) return false;
  request.content_size = content.size();
  slot_.request = request;
  slot_.is_applied = 0;
  const std::uint32_t next = state + (1U << exchange::kStateBits);
  if (!slot_.state.compare_exchange_strong(state, WithState(next, CycleState::kPosted))) {
    return false;
  }
  const std::uint32_t posted = bell_.posted.fetch_add(1) + 1;
  if (exchange::HasReached(posted, bell_.wanted) || request.instant_ns <= bell_.now_ns) {
    exchange::Ring(bell_);
  }
  return true;
}

CycleState CycleClient::Await() {
  const Clock::time_point lease_ends = Clock::now() + kLease;
  const std::chrono::nanoseconds until = lease_ends.time_since_epoch();
  std::uint32_t state = slot_.state;
  while (IsPending(StateOf(state))) {
    if (exchange::FutexWait(slot_.state, state, until)) {
      state = slot_.state;
      continue;
    }
    // The simulation has taken the request, and will apply it soon. The caller must know whether
    // the request was applied, so wait for at most another lease. This is too short only if the
    // simulation was killed or stopped before it could apply the request.
    if (StateOf(state) == CycleState::kTaken && slot_.is_applied == 0 &&
        Clock::now() < lease_ends + kLease) {
      std::this_thread::yield();
      state = slot_.state;
      continue;
    }
    if (slot_.state.compare_exchange_strong(state, WithState(state, CycleState::kRepeat))) {
      return CycleState::kRepeat;
    }
  }
  return StateOf(state);
}

bool CycleClient::Read(Answer& answer) {
  const exchange::CycleAnswer from = slot_.answer;
  const std::size_t size = std::min<std::size_t>(from.content_size, sizeof slot_.content);
  exchange::ContentReader content({slot_.content, size});
  const auto count = content.Take<std::uint64_t>();
  std::size_t i = 0;
  for (; i < count && content.ok(); ++i) {
    if (i == answer.readings.size()) answer.readings.emplace_back();
    ReadReading(content, answer.readings[i]);
  }
  answer.readings.resize(i);
  answer.reached = SimTime(from.reached_ns);
  answer.holds_time = from.holds_time != 0;
  return content.ok();
}

void CycleClient::Interrupt() {
  std::uint32_t state = slot_.state;
  while (IsPending(StateOf(state))) {
    if (slot_.state.compare_exchange_weak(state, WithState(state, CycleState::kRepeat))) {
      exchange::FutexWake(slot_.state);
      return;
    }
  }
}

}  // namespace gsv::sdk
