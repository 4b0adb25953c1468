// A connection of omniORB's that hands on whole messages only.
//
// omniORB 4.2.5 takes what comes on a connection during a call for that call's, if it bears its
// number: a last fragment that comes twice has two threads work on one call, and the process dies.
// Here fragments are joined before the ORB sees them, what is no message or too long ends its
// connection, and requests to cancel, which nobody here heeds, are left out.
//
// `Base`   a connection that a client made; its Recv() reads from the socket.
// Threads  as omniORB's connections: one reads at a time.
#pragma once

#include <chrono>
#include <string>
#include <utility>

#include <omniORB4/CORBA.h>

#include "gsv/orb/incoming_message.h"

namespace gsv::orb {

struct MessageLimits {
  std::size_t bytes = 64u << 20;  // of a message, with its header
  std::chrono::seconds time{30};  // from its first byte to its last
  // Looks through a whole message, and cuts off what the ORB is not to see. Null: it sees all.
  void (*check)(std::string& message) = nullptr;
};

template <typename Base>
class WholeMessages : public Base {
 public:
  template <typename... Arguments>
  explicit WholeMessages(const MessageLimits& limits, Arguments&&... arguments)
      : Base(std::forward<Arguments>(arguments)...),
        incoming_(limits.bytes),
        time_(limits.time),
        check_(limits.check) {}

  int Recv(void* buffer, std::size_t size, const omni_time_t& deadline) override {
    while (!incoming_.IsThere()) {
      MessageAssembly& assembly = incoming_.assembly();
      // Clients may be silent between messages, not within one.
      if (assembly.empty()) until_ = deadline;
      if (!assembly.empty() && !until_) {
        omni_thread::get_time(until_, omni_time_t(time_.count(), 0));
      }
      const auto room = assembly.Next();
      const int received = Base::Recv(room.bytes, room.size, until_);
      if (received <= 0) return received;
      assembly.Take(static_cast<std::size_t>(received));
      if (check_ != nullptr && assembly.state() == MessageAssembly::State::kComplete) {
        check_(assembly.message());
      }
    }
    return incoming_.HandOut(buffer, size);
  }

 private:
  IncomingMessage incoming_;
  const std::chrono::seconds time_;
  void (*const check_)(std::string&);
  omni_time_t until_;
};

}  // namespace gsv::orb
