// The cursors behind iterators. A cursor holds results that a client fetches in several calls.
//
// `Entries` is a list of results in order, with size() and operator[].
//
// The number of cursors, the number of stored entries, and the time since the last use are limited.
// The least recently used cursor is removed first.
//
// Threads  every member may be called at any time.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "gsv/base/mutex.h"

namespace gsv::broker {

struct CursorLimits {
  std::size_t cursors = 1000;       // maximum number of open cursors
  std::size_t entries = 2'000'000;  // maximum number of entries in all open cursors
  // A cursor that is not used for this time is removed.
  std::chrono::nanoseconds lifetime = std::chrono::seconds(60);
};

// Returns the number of entries from `next` on that fit into one answer: at most `count` entries,
// with a total size (by `size_of`) of at most `bytes`. Returns at least 1 if entries remain and
// `count` is not 0.
template <typename Entries, typename SizeOf>
std::size_t CountFitting(const Entries& entries, std::size_t next, std::size_t count,
                         std::size_t bytes, const SizeOf& size_of) {
  const std::size_t max_taken = std::min(count, entries.size() - next);
  std::size_t taken_bytes = 0;
  for (std::size_t taken = 0; taken < max_taken; ++taken) {
    taken_bytes += size_of(entries[next + taken]);
    if (taken > 0 && taken_bytes > bytes) return taken;
  }
  return max_taken;
}

template <typename Entries, typename Context>
class CursorTable {
 public:
  using Entry = std::decay_t<decltype(std::declval<const Entries&>()[0])>;
  using Clock = std::function<std::chrono::steady_clock::time_point()>;
  // Returns the size of an entry in a reply, in bytes.
  using SizeOf = std::function<std::size_t(const Entry&, const Context&)>;

  // The entries that one call of Take() returns.
  struct Batch {
    std::vector<Entry> entries;
    // The value that Open() stored with the cursor.
    Context context;
    bool more = false;  // whether entries remain
  };

  explicit CursorTable(const CursorLimits& limits, Clock clock = std::chrono::steady_clock::now)
      : limits_(limits), clock_(std::move(clock)) {}

  // Opens a cursor. `entries` has at most limits.entries elements.
  std::uint64_t Open(Entries entries, Context context) {
    const base::MutexLock lock(mutex_);
    RemoveExpired();
    while (!cursors_.empty() &&
           (cursors_.size() >= limits_.cursors || held_ + entries.size() > limits_.entries)) {
      Remove(LeastRecentlyUsed());
    }
    held_ += entries.size();
    const std::uint64_t key = next_key_++;
    cursors_.emplace(key, Cursor{std::move(entries), 0, std::move(context), clock_()});
    return key;
  }

  // Takes the next entries, see CountFitting(). Returns nullopt if there is no such cursor.
  std::optional<Batch> Take(std::uint64_t key, std::size_t count, std::size_t bytes,
                            const SizeOf& size_of) {
    const base::MutexLock lock(mutex_);
    Cursor* cursor = Use(key);
    if (cursor == nullptr) return std::nullopt;
    const std::size_t taken =
        CountFitting(cursor->entries, cursor->next, count, bytes,
                     [&](const Entry& entry) { return size_of(entry, cursor->context); });
    Batch batch{{}, cursor->context, false};
    batch.entries.reserve(taken);
    for (std::size_t i = 0; i < taken; ++i) {
      batch.entries.push_back(cursor->entries[cursor->next++]);
    }
    batch.more = cursor->next < cursor->entries.size();
    return batch;
  }

  // Returns a copy of all entries of the cursor. Returns nullopt if there is no such cursor.
  std::optional<Entries> EntriesOf(std::uint64_t key) {
    const base::MutexLock lock(mutex_);
    const Cursor* cursor = Use(key);
    if (cursor == nullptr) return std::nullopt;
    return cursor->entries;
  }

  // Returns the number of entries that are not fetched yet. Returns nullopt if there is no such
  // cursor.
  std::optional<std::size_t> Left(std::uint64_t key) {
    const base::MutexLock lock(mutex_);
    const Cursor* cursor = Use(key);
    if (cursor == nullptr) return std::nullopt;
    return cursor->entries.size() - cursor->next;
  }

  // Closes a cursor. Returns false if there is no such cursor.
  bool Close(std::uint64_t key) {
    const base::MutexLock lock(mutex_);
    const auto found = cursors_.find(key);
    if (found == cursors_.end()) return false;
    Remove(found);
    return true;
  }

  // Removes cursors that have not been used for their lifetime.
  void Expire() {
    const base::MutexLock lock(mutex_);
    RemoveExpired();
  }

  std::size_t size() const {
    const base::MutexLock lock(mutex_);
    return cursors_.size();
  }

 private:
  // The results of one iterator that are not fetched yet: `entries` from `next` on.
  struct Cursor {
    Entries entries;
    std::size_t next = 0;  // index in `entries`
    Context context;
    std::chrono::steady_clock::time_point used;  // time of the last use
  };
  using Cursors = std::map<std::uint64_t, Cursor>;

  // Returns the cursor and notes that it is used now. Returns null if there is no such cursor.
  Cursor* Use(std::uint64_t key) GSV_REQUIRES(mutex_) {
    RemoveExpired();
    const auto found = cursors_.find(key);
    if (found == cursors_.end()) return nullptr;
    found->second.used = clock_();
    return &found->second;
  }

  // Removes the cursors that were not used for the lifetime of a cursor.
  void RemoveExpired() GSV_REQUIRES(mutex_) {
    const auto now = clock_();
    for (auto cursor = cursors_.begin(); cursor != cursors_.end();) {
      const auto next = std::next(cursor);
      if (now - cursor->second.used > limits_.lifetime) Remove(cursor);
      cursor = next;
    }
  }

  // Returns the cursor that was not used for the longest time.
  typename Cursors::iterator LeastRecentlyUsed() GSV_REQUIRES(mutex_) {
    return std::min_element(cursors_.begin(), cursors_.end(), [](const auto& a, const auto& b) {
      return a.second.used < b.second.used;
    });
  }

  // Removes a cursor with its remaining entries.
  void Remove(typename Cursors::iterator cursor) GSV_REQUIRES(mutex_) {
    held_ -= cursor->second.entries.size();
    cursors_.erase(cursor);
  }

  const CursorLimits limits_;
  const Clock clock_;
  mutable base::Mutex mutex_;
  Cursors cursors_ GSV_GUARDED_BY(mutex_);
  std::size_t held_ GSV_GUARDED_BY(mutex_) = 0;  // number of entries of all cursors
  std::uint64_t next_key_ GSV_GUARDED_BY(mutex_) = 1;
};

}  // namespace gsv::broker
