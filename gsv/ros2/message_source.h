// Publishes a message on one topic. The message depends only on the snapshot.
#pragma once

#include <functional>
#include <utility>

#include "gsv/messages/cdr.h"
#include "gsv/ros2/node.h"
#include "gsv/ros2/source.h"

namespace gsv::ros2 {

template <typename Message>
class MessageSource final : public Source {
 public:
  using Make = std::function<Message(const world::Snapshot& snapshot)>;

  // `writer` may be null; otherwise it must outlive this object.
  MessageSource(base::SimTime period, dds::Writer* writer, Make make)
      : Source(period), writer_(writer), make_(std::move(make)) {}

  bool is_wanted() const override { return writer_ != nullptr && writer_->has_readers(); }
  void Publish(const Moment& moment) override {
    buffer_.clear();
    messages::Encode(make_(*moment.snapshot), buffer_);
    writer_->Write(buffer_);
  }

 private:
  dds::Writer* const writer_;
  const Make make_;  // makes the message of a snapshot
  messages::Bytes buffer_;
};

// Sends one message now.
template <typename Message>
void Send(const Message& message, dds::Writer* writer) {
  if (writer == nullptr) return;
  messages::Bytes bytes;
  messages::Encode(message, bytes);
  writer->Write(bytes);
}

}  // namespace gsv::ros2
