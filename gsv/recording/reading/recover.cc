#include "gsv/recording/reading/recover.h"

#include <cstdio>
#include <filesystem>
#include <set>
#include <system_error>

#include <nlohmann/json.hpp>

#include "gsv/base/counted.h"
#include "gsv/recording/mcap/bag_folder.h"
#include "gsv/recording/mcap/mcap_file_writer.h"
#include "gsv/recording/reading/lasting_messages.h"

namespace gsv::recording {
namespace {

using base::ErrorCode;
using base::Fail;

class Copier {
 public:
  Copier(const McapReader& reader, ByteSink& sink, const Selection& selection)
      : reader_(reader), selection_(selection), file_(sink, {.profile = reader.summary().profile}) {
    recovery_.problems = reader.summary().problems;
  }

  base::Result<Recovery> Run() {
    const Summary& summary = reader_.summary();
    for (const auto& [id, schema] : summary.schemas) file_.AddSchema(schema);
    for (const auto& [id, channel] : summary.channels) {
      if (!selection_.Has(channel.topic)) continue;
      file_.AddChannel(channel);
      selected_.insert(id);
    }
    for (const MetadataIndexRecord& index : summary.metadata) CopyMetadata(index);
    for (const AttachmentIndexRecord& index : summary.attachments) CopyAttachment(index);
    if (selection_.from > summary.start) CopyLasting();
    for (const MessageBlock& block : summary.blocks) CopyMessages(block);
    if (base::Status status = file_.Close(); !status) return Fail(std::move(status.error()));
    return std::move(recovery_);
  }

 private:
  void CopyMetadata(const MetadataIndexRecord& index) {
    const auto metadata = reader_.Read(index);
    if (!metadata) return ReportLoss(metadata.error());
    file_.AddMetadata(*metadata);
    ++recovery_.metadata;
  }

  void CopyAttachment(const AttachmentIndexRecord& index) {
    const auto attachment = reader_.Read(index);
    if (!attachment) return ReportLoss(attachment.error());
    file_.Attach({attachment->log_time, attachment->create_time, attachment->name,
                  attachment->media_type, attachment->data});
    ++recovery_.attachments;
  }

  // Copies the messages that are still valid at the start of the selection (lasting_messages.h).
  // Their log time becomes this start. They keep their publish time.
  void CopyLasting() {
    LastingMessages lasting = FindLastingMessages(reader_, selection_.from);
    for (const LastingMessage& message : lasting.messages) {
      if (!selected_.contains(message.channel_id)) continue;
      file_.Write({message.channel_id, message.sequence, selection_.from, message.publish_time,
                   message.data});
      ++recovery_.messages;
    }
    // Problems in blocks are not added here, because CopyMessages() reads the same blocks and
    // reports each problem once.
  }

  void CopyMessages(const MessageBlock& block) {
    const auto content = reader_.Messages(block);
    if (!content) return ReportLoss(content.error());
    for (const MessageRecord& message : content->messages) {
      if (!selected_.contains(message.channel_id) || !selection_.Has(message.log_time)) continue;
      file_.Write(message);
      ++recovery_.messages;
    }
  }

  void ReportLoss(const base::Error& error) {
    recovery_.problems.push_back({base::Problem::Severity::kWarning, error.message, error.where});
  }

  const McapReader& reader_;
  const Selection& selection_;
  std::set<std::uint16_t> selected_;  // ids of the selected topics' channels
  McapFileWriter file_;
  Recovery recovery_;
};

// An output file that has a temporary name while it is written. The destructor removes the file
// unless it was renamed.
class PartialFile {
 public:
  explicit PartialFile(std::string path) : path_(std::move(path)) {}
  ~PartialFile() { std::remove(path_.c_str()); }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

base::Result<Recovery> RecoverToFile(const std::string& input, const std::string& output,
                                     const Selection& selection, const Limits& limits) {
  const auto reader = McapReader::Open(input, limits);
  if (!reader) return Fail(reader.error());
  std::error_code ignored;
  if (std::filesystem::exists(output, ignored)) {
    return Fail(ErrorCode::kInvalidArgument,
                "the file exists already; give the new recording another name", output);
  }
  const PartialFile partial(output + ".partial");
  auto sink = FileSink::Create(partial.path(), true);
  if (!sink) return Fail(std::move(sink.error()));
  base::Result<Recovery> recovery = Copier(**reader, **sink, selection).Run();
  if (!recovery) return recovery;
  std::error_code error;
  std::filesystem::rename(partial.path(), output, error);
  if (error) {
    return Fail(ErrorCode::kUnavailable, "cannot rename the finished file: " + error.message(),
                output);
  }
  return recovery;
}

// Recovers into a bag: a folder with the recording and its metadata.yaml.
base::Result<Recovery> RecoverToFolder(const std::string& input, const std::string& output,
                                       const Selection& selection, const Limits& limits) {
  const auto file = MakeBagFolder(output);
  if (!file) return Fail(file.error());
  auto recovery = RecoverToFile(input, *file, selection, limits);
  const base::Status complete = recovery ? WriteBagMetadata(*file) : base::Status();
  if (recovery && complete) return recovery;
  std::error_code ignored;
  std::filesystem::remove_all(output, ignored);
  return Fail(recovery ? complete.error() : recovery.error());
}

}  // namespace

base::Result<Recovery> Recover(const McapReader& reader, ByteSink& sink,
                               const Selection& selection) {
  return Copier(reader, sink, selection).Run();
}

base::Result<Recovery> Recover(const std::string& input, const std::string& output,
                               const Selection& selection, const Limits& limits) {
  std::error_code none;
  const bool to_folder = std::filesystem::is_directory(input, none) &&
                         std::filesystem::path(output).extension() != ".mcap";
  return to_folder ? RecoverToFolder(input, output, selection, limits)
                   : RecoverToFile(input, output, selection, limits);
}

std::string ToText(const Recovery& recovery) {
  std::string text = "recovered " + base::Counted(recovery.messages, "message") + ", " +
                     base::Counted(recovery.attachments, "attachment") + ", " +
                     base::Counted(recovery.metadata, "metadata record") + "\n";
  for (const base::Problem& problem : recovery.problems) {
    text += "warning: " + problem.Sentence() + "\n";
  }
  return text;
}

std::string ToJson(const Recovery& recovery) {
  nlohmann::ordered_json json{{"messages", recovery.messages},
                              {"attachments", recovery.attachments},
                              {"metadata", recovery.metadata},
                              {"warnings", nlohmann::ordered_json::array()}};
  for (const base::Problem& problem : recovery.problems) {
    json["warnings"].push_back(problem.Sentence());
  }
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace gsv::recording
