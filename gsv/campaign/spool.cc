#include "gsv/campaign/spool.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "gsv/base/atomic_file.h"
#include "gsv/base/sorting.h"
#include "gsv/base/text_file.h"

namespace gsv::campaign {
namespace {

namespace fs = std::filesystem;

base::Result<std::vector<fs::path>> FilesIn(const fs::path& folder, std::string_view ending) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().native().ends_with(ending)) files.push_back(entry->path());
  }
  if (error) {
    return base::Fail(base::ErrorCode::kUnavailable, "cannot be read: " + error.message(), folder);
  }
  base::Sort(files);
  return files;
}

}  // namespace

std::vector<std::int64_t> Batch::RunsOf(std::size_t task) const {
  const std::size_t first = std::min(task * runs_per_task, runs.size());
  const std::size_t end = std::min(first + runs_per_task, runs.size());
  return {runs.begin() + static_cast<std::ptrdiff_t>(first),
          runs.begin() + static_cast<std::ptrdiff_t>(end)};
}

std::string Batch::ShareOf(std::size_t task) const {
  return fmt::format("batch-{:04}-task-{:04}", number, task);
}

std::string ShardName(std::size_t index, std::size_t count) {
  return fmt::format("shard-{}-of-{}", index, count);
}

base::Result<Batch> ReadBatch(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "does not exist; check that this machine can read the folder of the campaign",
                      file);
  }
  Batch batch;
  try {
    const auto json = nlohmann::json::parse(base::ReadTextFile(file));
    json.at("number").get_to(batch.number);
    json.at("name").get_to(batch.name);
    json.at("job").get_to(batch.job);
    json.at("submitted").get_to(batch.submitted);
    batch.runs_per_task = std::max<std::size_t>(1, json.at("runs_a_task").get<std::size_t>());
    json.at("runs").get_to(batch.runs);
    json.at("timeout_s").get_to(batch.timeout);
    json.at("failures").get_to(batch.failures);
  } catch (const nlohmann::json::exception&) {
    return base::Fail(
        base::ErrorCode::kCorrupt,
        "this file of a submitted batch is damaged; wait until the queue has no jobs of "
        "this campaign, then remove the file",
        file);
  }
  return batch;
}

base::Result<Spool> Spool::Make(const fs::path& folder, const Campaign& campaign) {
  std::error_code error;
  fs::create_directories(folder / "journals", error);
  if (!error) fs::create_directories(folder / "logs", error);
  if (error) {
    return base::Fail(base::ErrorCode::kUnavailable, "cannot create the folder: " + error.message(),
                      folder);
  }
  // Shards that start at the same time may write this file together; they write the same content.
  const fs::path whole = fs::absolute(folder, error);
  if (!fs::exists(whole / "plan.json", error)) {
    if (auto ok = base::WriteAtomically(whole / "plan.json", ToJson(campaign),
                                        base::Durability::kPowerLoss);
        !ok) {
      return base::Fail(ok.error());
    }
  }
  auto spool = Open(whole);
  if (spool && spool->campaign().Identity() != campaign.Identity()) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "has runs of another campaign, or of an earlier version of this one; choose "
                      "another file with --results, or remove the folder",
                      folder);
  }
  return spool;
}

base::Result<Spool> Spool::Open(const fs::path& folder) {
  std::error_code error;
  const fs::path file = folder / "plan.json";
  if (!fs::exists(file, error))
    return base::Fail(base::ErrorCode::kNotFound, "no runs were submitted from this folder",
                      folder);
  auto campaign = CampaignInJson(base::ReadTextFile(file));
  if (!campaign) return base::Fail(campaign.error().code, campaign.error().message, file);
  return Spool(folder, *std::move(campaign));
}

fs::path Spool::FileOf(const Batch& batch) const {
  return folder_ / fmt::format("batch-{:04}.json", batch.number);
}

fs::path Spool::LogOf(const Batch& batch, const std::string& task) const {
  return logs() / (batch.name + "-" + task + ".log");
}

base::Result<std::vector<Batch>> Spool::Batches() const {
  const auto files = FilesIn(folder_, ".json");
  if (!files) return base::Fail(files.error());
  std::vector<Batch> batches;
  for (const fs::path& file : *files) {
    if (!file.filename().native().starts_with("batch-")) continue;
    auto batch = ReadBatch(file);
    if (!batch) return base::Fail(batch.error());
    batches.push_back(*std::move(batch));
  }
  base::Sort(batches, [](const Batch& a, const Batch& b) { return a.number < b.number; });
  return batches;
}

base::Status Spool::Put(const Batch& batch) const {
  const nlohmann::ordered_json json{{"number", batch.number},
                                    {"name", batch.name},
                                    {"job", batch.job},
                                    {"submitted", batch.submitted},
                                    {"runs_a_task", batch.runs_per_task},
                                    {"timeout_s", batch.timeout},
                                    {"failures", batch.failures},
                                    {"runs", batch.runs}};
  return base::WriteAtomically(FileOf(batch), json.dump() + "\n", base::Durability::kPowerLoss);
}

void Spool::Remove(const Batch& batch) const {
  std::error_code ignored;
  fs::remove(FileOf(batch), ignored);
}

base::Result<std::vector<RunResult>> Spool::Collect(const std::string& share) {
  const auto files = FilesIn(journals(), ".journal");
  if (!files) return base::Fail(files.error());
  for (const fs::path& file : *files) {
    const std::string name = file.filename();
    if (share.empty() || name.starts_with(share + ".")) readers_.try_emplace(name, file);
  }
  std::vector<RunResult> results;
  for (auto& [name, reader] : readers_) {
    auto more = reader.ReadNew();
    if (!more) return base::Fail(more.error());
    std::move(more->begin(), more->end(), std::back_inserter(results));
  }
  return results;
}

std::vector<Attempt> Spool::Attempts() const {
  std::vector<Attempt> attempts;
  for (const auto& [name, reader] : readers_) {
    if (reader.attempt()) attempts.push_back(*reader.attempt());
  }
  return attempts;
}

base::Result<std::size_t> Gather(Spool& spool, Results& results) {
  std::vector<Attempt> before = spool.Attempts();
  const auto collected = spool.Collect();
  if (!collected) return base::Fail(collected.error());
  std::vector<Attempt> attempts = spool.Attempts();
  if (collected->empty() && attempts == before) return std::size_t{0};
  const auto planned = static_cast<std::int64_t>(spool.campaign().runs());
  std::vector<RunResult> known;
  for (const RunResult& result : *collected) {
    if (result.run >= 0 && result.run < planned) known.push_back(result);
  }
  if (auto ok = results.Add(known, attempts); !ok) return base::Fail(ok.error());
  return known.size();
}

}  // namespace gsv::campaign
