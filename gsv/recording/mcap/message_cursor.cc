#include "gsv/recording/mcap/message_cursor.h"

#include <algorithm>
#include <tuple>

namespace gsv::recording {

bool MessageCursor::Later::operator()(const OpenBlock* a, const OpenBlock* b) const {
  return std::tuple(a->front().log_time, a->offset) > std::tuple(b->front().log_time, b->offset);
}

MessageCursor::MessageCursor(const ByteSource& source, const Summary& summary, const Limits& limits,
                             base::SimTime from)
    : source_(source), summary_(summary), limits_(limits), from_(from) {
  for (const MessageBlock& block : summary.blocks) {
    if (block.end >= from) waiting_.push_back(&block);
  }
  std::sort(waiting_.begin(), waiting_.end(), [](const MessageBlock* a, const MessageBlock* b) {
    return std::tuple(a->start, a->offset) > std::tuple(b->start, b->offset);
  });
}

base::Result<std::optional<MessageRecord>> MessageCursor::Next() {
  DropExhausted();
  if (base::Status status = OpenBlocksThatMayBeNext(); !status) {
    return base::Fail(std::move(status.error()));
  }
  if (next_.empty()) return std::nullopt;
  OpenBlock* block = next_.top();
  next_.pop();
  const MessageRecord message = block->front();
  if (++block->next < block->content.messages.size()) {
    next_.push(block);
  } else {
    exhausted_ = block;
  }
  return message;
}

base::Status MessageCursor::OpenBlocksThatMayBeNext() {
  while (!waiting_.empty() &&
         (next_.empty() || waiting_.back()->start <= next_.top()->front().log_time)) {
    const MessageBlock* block = waiting_.back();
    waiting_.pop_back();
    if (base::Status status = Open(*block); !status) return status;
  }
  return {};
}

base::Status MessageCursor::Open(const MessageBlock& block) {
  if (block.uncompressed_size > limits_.open_blocks_size - open_size_) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "too many chunks overlap in time to read their messages in order",
                      "byte " + std::to_string(block.offset));
  }
  auto content = ReadMessages(source_, block, summary_.channels, limits_);
  if (!content) return base::Fail(std::move(content.error()));
  std::vector<MessageRecord>& messages = content->messages;
  std::erase_if(messages, [&](const MessageRecord& each) { return each.log_time < from_; });
  std::stable_sort(
      messages.begin(), messages.end(),
      [](const MessageRecord& a, const MessageRecord& b) { return a.log_time < b.log_time; });
  if (messages.empty()) return {};
  open_size_ += content->records.size();
  open_.push_back(std::make_unique<OpenBlock>(OpenBlock{block.offset, std::move(*content), 0}));
  next_.push(open_.back().get());
  return {};
}

void MessageCursor::DropExhausted() {
  if (exhausted_ == nullptr) return;
  open_size_ -= exhausted_->content.records.size();
  std::erase_if(open_, [&](const auto& each) { return each.get() == exhausted_; });
  exhausted_ = nullptr;
}

}  // namespace gsv::recording
