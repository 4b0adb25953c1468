#include "gsv/recording/reading/newest_messages.h"

#include <algorithm>
#include <vector>

#include "gsv/base/sorting.h"

namespace gsv::recording {
namespace {

class Search {
 public:
  Search(const McapReader& reader, base::SimTime time) : reader_(reader), time_(time) {}

  NewestMessages Run() {
    std::vector<const MessageBlock*> blocks;
    for (const MessageBlock& block : reader_.summary().blocks) {
      if (block.start <= time_) blocks.push_back(&block);
    }
    // The block that ends last is read first, because it may have the newest messages.
    base::Sort(blocks,
               [](const MessageBlock* a, const MessageBlock* b) { return a->end > b->end; });
    for (const MessageBlock* block : blocks) {
      if (MayHoldNewer(*block)) ReadBlock(*block);
    }
    return std::move(result_);
  }

 private:
  bool MayHoldNewer(const MessageBlock& block) const {
    const base::SimTime latest = std::min(block.end, time_);
    const auto is_open = [&](std::uint16_t channel) {
      const auto found = result_.by_channel.find(channel);
      return found == result_.by_channel.end() || found->second.log_time < latest;
    };
    if (!block.channels.empty()) {
      return std::any_of(block.channels.begin(), block.channels.end(), is_open);
    }
    const Channels& all = reader_.summary().channels;
    return std::any_of(all.begin(), all.end(),
                       [&](const auto& each) { return is_open(each.first); });
  }

  void ReadBlock(const MessageBlock& block) {
    const base::Result<BlockMessages> content = reader_.Messages(block);
    if (!content) {
      result_.problems.push_back(
          {base::Problem::Severity::kWarning, content.error().message, content.error().where});
      return;
    }
    // The newest message of each channel. Only these messages are copied.
    std::map<std::uint16_t, const MessageRecord*> newest;
    for (const MessageRecord& message : content->messages) {
      if (message.log_time > time_) continue;
      const MessageRecord*& known = newest[message.channel_id];
      if (known == nullptr || message.log_time >= known->log_time) known = &message;
    }
    for (const auto& [channel, message] : newest) {
      const auto found = result_.by_channel.find(channel);
      if (found != result_.by_channel.end() && found->second.log_time >= message->log_time)
        continue;
      result_.by_channel[channel] = {message->log_time,
                                     Bytes(message->data.begin(), message->data.end())};
    }
  }

  const McapReader& reader_;
  const base::SimTime time_;
  NewestMessages result_;
};

}  // namespace

NewestMessages FindNewestMessages(const McapReader& reader, base::SimTime time) {
  return Search(reader, time).Run();
}

}  // namespace gsv::recording
