#include "gsv/recording/mcap/mcap_summary.h"

#include <algorithm>

#include "gsv/base/sorting.h"
#include "gsv/recording/mcap/compression.h"

namespace gsv::recording {
namespace {

// Reads the summary at the end of a file. Any damage makes the whole summary unusable. Each member
// function returns what is wrong with the file or its summary, or nullopt if nothing is.
class SummaryReader {
 public:
  using Reason = std::optional<std::string>;

  SummaryReader(const ByteSource& source, const Limits& limits, Summary& summary)
      : source_(source), limits_(limits), summary_(summary) {}

  Reason Read() {
    Reason reason = ReadSection();
    if (!reason) reason = ReadRecords();
    if (!reason) reason = Check();
    if (!reason) reason = ReadHeader();
    summary_.indexed = !reason;
    return reason;
  }

 private:
  static constexpr std::uint64_t kEndSize = kFooterSize + kMagic.size();

  Reason ReadSection() {
    const std::uint64_t size = source_.size();
    if (size < kMagic.size() + kEndSize) return "it was not closed";
    const base::Result<Bytes> end = source_.Read(size - kEndSize, kEndSize);
    if (!end) return end.error().Sentence();
    if (!std::equal(kMagic.begin(), kMagic.end(), end->end() - kMagic.size())) {
      return "it was not closed";
    }
    std::span<const std::byte> rest = *end;
    const std::optional<RawRecord> record = TakeRecord(rest);
    std::optional<FooterRecord> footer;
    if (record && record->opcode == Opcode::kFooter) footer = Parse<FooterRecord>(record->content);
    if (!footer) return "its footer is damaged";
    if (footer->summary_start == 0) return "it has no summary";

    const std::uint64_t section_end = size - kEndSize;
    start_ = footer->summary_start;
    if (start_ < kMagic.size() || start_ > section_end ||
        section_end - start_ > limits_.summary_size) {
      return "its footer gives a wrong position of the summary";
    }
    base::Result<Bytes> section = source_.Read(start_, section_end - start_);
    if (!section) return section.error().Sentence();
    section_ = std::move(*section);
    // The checksum covers all bytes in front of itself.
    const auto footer_head = std::span(*end).first(kFooterSize - sizeof(std::uint32_t));
    if (footer->summary_crc != 0 && footer->summary_crc != Crc32(footer_head, Crc32(section_))) {
      return "its summary's checksum is wrong";
    }
    return std::nullopt;
  }

  Reason ReadRecords() {
    for (std::span<const std::byte> rest = section_; !rest.empty();) {
      const std::optional<RawRecord> record = TakeRecord(rest);
      if (!record || !Add(*record)) return "its summary is damaged";
    }
    return std::nullopt;
  }

  bool Add(const RawRecord& record) {
    switch (record.opcode) {
      case Opcode::kSchema:
        return AddById(record, summary_.schemas);
      case Opcode::kChannel:
        return AddById(record, summary_.channels);
      case Opcode::kAttachmentIndex:
        return AddTo(record, summary_.attachments);
      case Opcode::kMetadataIndex:
        return AddTo(record, summary_.metadata);
      case Opcode::kChunkIndex:
        return AddChunk(record);
      case Opcode::kStatistics:
        statistics_ = Parse<StatisticsRecord>(record.content);
        return statistics_.has_value();
      default:
        return true;
    }
  }

  template <typename Record>
  static bool AddById(const RawRecord& raw, std::map<std::uint16_t, Record>& map) {
    auto record = Parse<Record>(raw.content);
    if (record) map.emplace(record->id, std::move(*record));
    return record.has_value();
  }

  template <typename Record>
  static bool AddTo(const RawRecord& raw, std::vector<Record>& list) {
    auto record = Parse<Record>(raw.content);
    if (record) list.push_back(std::move(*record));
    return record.has_value();
  }

  bool AddChunk(const RawRecord& raw) {
    const auto index = Parse<ChunkIndexRecord>(raw.content);
    if (!index) return false;
    summary_.blocks.push_back({index->chunk_offset, index->chunk_length, true,
                               index->uncompressed_size, index->start, index->end});
    for (const auto& [channel, offset] : index->message_index_offsets) {
      summary_.blocks.back().channels.push_back(channel);
    }
    return true;
  }

  Reason Check() {
    if (!statistics_) return "its summary has no statistics";
    summary_.message_count = statistics_->message_count;
    summary_.message_counts = std::move(statistics_->channel_message_counts);
    summary_.start = statistics_->start;
    summary_.end = statistics_->end;
    std::vector<MessageBlock>& blocks = summary_.blocks;
    if (summary_.message_count > 0 && blocks.empty()) return "its summary has no chunks";
    base::Sort(blocks,
               [](const MessageBlock& a, const MessageBlock& b) { return a.offset < b.offset; });
    // Chunks must not overlap in the file; otherwise their total size could be many times the size
    // of the file.
    std::uint64_t free_from = kMagic.size();
    for (const MessageBlock& block : blocks) {
      if (block.offset < free_from || block.offset > start_ ||
          block.length > start_ - block.offset) {
        return "its summary's chunks overlap";
      }
      free_from = block.offset + block.length;
    }
    return std::nullopt;
  }

  Reason ReadHeader() {
    const std::uint64_t most = std::min<std::uint64_t>(start_ - kMagic.size(), 64 << 10);
    const base::Result<Bytes> bytes = source_.Read(kMagic.size(), most);
    if (!bytes) return bytes.error().Sentence();
    std::span<const std::byte> rest = *bytes;
    const std::optional<RawRecord> record = TakeRecord(rest);
    std::optional<HeaderRecord> header;
    if (record && record->opcode == Opcode::kHeader) header = Parse<HeaderRecord>(record->content);
    if (!header) return "its header is damaged";
    summary_.profile = std::move(header->profile);
    summary_.library = std::move(header->library);
    return std::nullopt;
  }

  const ByteSource& source_;
  const Limits& limits_;
  Summary& summary_;
  std::uint64_t start_ = 0;
  Bytes section_;
  std::optional<StatisticsRecord> statistics_;
};

}  // namespace

base::Result<Summary> LoadSummary(const ByteSource& source, const Limits& limits) {
  Summary summary;
  const SummaryReader::Reason reason = SummaryReader(source, limits, summary).Read();
  if (!reason) return summary;
  base::Result<Summary> scanned = ScanForSummary(source, limits);
  if (scanned) {
    scanned->problems.insert(scanned->problems.begin(),
                             {base::Problem::Severity::kWarning,
                              "the whole recording was read because " + *reason +
                                  "; 'gsv rec recover' makes an indexed copy",
                              {}});
  }
  return scanned;
}

}  // namespace gsv::recording
