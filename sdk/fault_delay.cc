#include "sdk/fault_delay.h"

#include <omniORB4/CORBA.h>

#include <atomic>
#include <charconv>
#include <cstdlib>
#include <thread>

#include <omniORB4/omniInterceptors.h>

#include "gsv/base/random.h"

namespace gsv::sdk {
namespace {

constexpr std::uint64_t kMaxMilliseconds = 60'000;

// The settings are global, because the ORB calls plain functions.
FaultDelay& Settings() {
  static FaultDelay settings;
  return settings;
}

void Delay() {
  static std::atomic<std::uint64_t> number{0};
  std::this_thread::sleep_for(NthDelay(Settings(), number++));
}

template <typename Info>
CORBA::Boolean Delay(Info&) {
  Delay();
  return true;  // lets further interceptors run
}

// Reads the number after `key` and "=" at the start of `text`, and removes the key, "=" and the
// number from `text`.
bool TakeNumber(std::string_view key, std::string_view& text, std::uint64_t& number) {
  if (!text.starts_with(key) || text.substr(key.size(), 1) != "=") return false;
  text.remove_prefix(key.size() + 1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

}  // namespace

base::Result<FaultDelay> ParseFaultDelay(std::string_view text) {
  FaultDelay fault;
  std::uint64_t milliseconds = 0;
  std::string_view rest = text;
  bool ok = TakeNumber("seed", rest, fault.seed) && rest.starts_with(",");
  if (ok) rest.remove_prefix(1);
  ok = ok && TakeNumber("max_ms", rest, milliseconds) && rest.empty() &&
       milliseconds <= kMaxMilliseconds;
  if (!ok) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "expected seed=NUMBER,max_ms=MILLISECONDS with at most 60000 ms",
                      "GSV_FAULT_DELAY=" + std::string(text));
  }
  fault.max = std::chrono::milliseconds(milliseconds);
  return fault;
}

std::chrono::nanoseconds NthDelay(const FaultDelay& fault, std::uint64_t n) {
  const double part = base::Noise(fault.seed, base::StableId("fault delay"), n).Uniform();
  const auto max = std::chrono::nanoseconds(fault.max);
  return std::chrono::nanoseconds(
      static_cast<std::int64_t>(part * static_cast<double>(max.count())));
}

void DelayCalls(const FaultDelay& fault) {
  Settings() = fault;
  omni::omniInterceptors* const interceptors = omniORB::getInterceptors();
  interceptors->clientSendRequest.add(&Delay<omni::omniInterceptors::clientSendRequest_T::info_T>);
  interceptors->clientReceiveReply.add(
      &Delay<omni::omniInterceptors::clientReceiveReply_T::info_T>);
}

void DelayOnce() {
  if (Settings().max.count() > 0) Delay();
}

base::Status DelayCallsFromEnvironment() {
  const char* text = std::getenv("GSV_FAULT_DELAY");
  if (text == nullptr || *text == '\0') return {};
  const auto fault = ParseFaultDelay(text);
  if (!fault) return base::Fail(fault.error());
  DelayCalls(*fault);
  return {};
}

}  // namespace gsv::sdk
