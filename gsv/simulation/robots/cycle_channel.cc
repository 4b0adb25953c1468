#include "gsv/simulation/robots/cycle_channel.h"

#include <algorithm>
#include <random>
#include <utility>

#include "gsv/simulation/robots/robot_agent.h"

namespace gsv::simulation {
namespace {

using exchange::CycleState;
using exchange::StateOf;
using exchange::WithState;

// The maximum size of the file, in bytes. A slot is never used twice, because the client of a
// closed slot may still write to the slot. So a simulation has at most 16,383 slots. Clocks without
// a slot use calls instead of shared memory.
constexpr std::uint64_t kMaxFileSize = 16'384 * exchange::kSlotSize;

}  // namespace

CycleChannel::CycleChannel(std::unique_ptr<exchange::Mapping> memory, ClockId clock,
                           std::weak_ptr<RobotAgent> agent)
    : memory_(std::move(memory)),
      slot_(*static_cast<exchange::CycleSlot*>(memory_->data())),
      clock_(clock),
      agent_(std::move(agent)) {}

std::optional<CycleChannel::Request> CycleChannel::Take() {
  std::uint32_t state = slot_.state;
  if (StateOf(state) != CycleState::kPosted) return std::nullopt;
  Request request{slot_.request, {}};
  const std::size_t size = std::min<std::size_t>(request.cycle.content_size, sizeof slot_.content);
  exchange::ContentReader content({slot_.content, size});
  if (request.cycle.cycle == 0) {
    const auto count = content.Take<std::uint64_t>();
    for (std::uint64_t i = 0; i < count && content.ok(); ++i) {
      request.sensors.emplace_back(content.TakeText());
    }
  }
  if (!slot_.state.compare_exchange_strong(state, WithState(state, CycleState::kTaken))) {
    return std::nullopt;  // the client has given up
  }
  if (content.ok()) return request;
  Refuse();
  return std::nullopt;
}

void CycleChannel::Accept(Request request) {
  const base::MutexLock lock(mutex_);
  request_ = std::move(request);
  slot_.is_applied = 1;
}

void CycleChannel::Refuse() {
  const std::uint32_t state = slot_.state;
  if (StateOf(state) == CycleState::kTaken) Change(state, CycleState::kRepeat);
}

void CycleChannel::SetDue(base::SimTime reached, bool holds_time) {
  const base::MutexLock lock(mutex_);
  due_ = Due{slot_.state, {reached.count(), holds_time, 0}};
}

void CycleChannel::Open() {
  const auto agent = agent_.lock();
  if (agent == nullptr) return;
  bool closes = false;
  {
    const base::MutexLock lock(mutex_);
    if (!due_) return;
    Due due = *std::exchange(due_, std::nullopt);
    if (slot_.state != due.state) return;  // the client has given up
    exchange::ContentWriter content(slot_.content);
    Readings readings = Readings::kByCall;
    if (request_.cycle.cycle != 0 || due.answer.holds_time != 0) {
      readings = agent->WriteReadings(request_, content);
    }
    if (readings == Readings::kWritten) {
      due.answer.content_size = content.size();
      slot_.answer = due.answer;
    }
    closes = readings == Readings::kAlwaysByCall;
    Change(due.state, readings == Readings::kWritten ? CycleState::kAnswered : CycleState::kRepeat);
  }
  if (closes) agent->CloseChannel(clock_);
}

void CycleChannel::Close() {
  slot_.state.store(WithState(slot_.state, CycleState::kClosed));
  exchange::FutexWake(slot_.state);
}

void CycleChannel::Change(std::uint32_t from, CycleState to) {
  if (slot_.state.compare_exchange_strong(from, WithState(from, to))) {
    exchange::FutexWake(slot_.state);
  }
}

base::Status CycleChannels::Prepare() {
  if (bell_ != nullptr) return {};
  auto file = exchange::SharedFile::Make();
  if (!file) return base::Fail(file.error());
  if (auto ok = (*file)->Grow(exchange::kSlotSize); !ok) return ok;
  auto bell = (*file)->Map(0, sizeof(exchange::Bell));
  if (!bell) return base::Fail(bell.error());
  size_ = exchange::kSlotSize;
  file_ = *std::move(file);
  bell_ = *std::move(bell);
  std::random_device random;
  this->bell()->key = (std::uint64_t{random()} << 32U) | random();
  return {};
}

base::Result<CycleChannels::Added> CycleChannels::Add(RobotAgent& agent,
                                                      std::weak_ptr<RobotAgent> shared,
                                                      ClockId clock) {
  if (size_ >= kMaxFileSize) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "the memory for control cycles is full; use calls instead");
  }
  if (auto ok = file_->Grow(size_ + exchange::kSlotSize); !ok) return base::Fail(ok.error());
  auto memory = file_->Map(size_, exchange::kSlotSize);
  if (!memory) return base::Fail(memory.error());
  const CycleMemory place{file_->address(), size_, bell()->key};
  auto channel = std::make_shared<CycleChannel>(*std::move(memory), clock, std::move(shared));
  size_ += exchange::kSlotSize;
  Close(agent, clock);
  channels_.push_back({channel, &agent});
  return Added{std::move(channel), place};
}

template <typename Predicate>
void CycleChannels::CloseIf(Predicate predicate) {
  std::erase_if(channels_, [&](const Channel& each) {
    const bool closes = predicate(each);
    if (closes) each.channel->Close();
    return closes;
  });
}

void CycleChannels::Close(const RobotAgent& agent, ClockId clock) {
  CloseIf(
      [&](const Channel& each) { return each.agent == &agent && each.channel->clock() == clock; });
}

void CycleChannels::Close(const RobotAgent& agent) {
  CloseIf([&](const Channel& each) { return each.agent == &agent; });
}

void CycleChannels::CloseAll() {
  CloseIf([](const Channel&) { return true; });
}

}  // namespace gsv::simulation
