// What a broker knows, in a file that survives it.
//
// Format   an SQLite database in WAL mode with synchronous=NORMAL: what was answered survives the
//          end of the process at any moment; a power cut may lose the last changes, never the
//          file. See docs/broker.md.
// Threads  a thread of its own writes; all changes that wait become one transaction.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/mutex.h"
#include "gsv/broker/storage/database.h"
#include "gsv/broker/trader/journal.h"

namespace gsv::broker {

class OfferFile : public Journal {
 public:
  // Opens the file, or makes one whose offers' ids will have `stem`. It is locked for other
  // processes then.
  // Errors  kUnavailable: it cannot be opened, or another broker uses it.
  //         kCorrupt: it is damaged, or not a broker's, or of a newer version.
  [[nodiscard]] static base::Result<std::unique_ptr<OfferFile>> Open(const std::string& path,
                                                                     std::uint32_t stem);
  ~OfferFile() override { Close(); }

  // All that was in the file when it was opened. Before the first Append.
  // Errors  kCorrupt.
  [[nodiscard]] base::Result<TraderState> Load();

  // The file does not grow beyond `pages` of 4 KiB; changes that need more are not kept. Before
  // the first Append.
  [[nodiscard]] base::Status LimitPages(int pages);

  bool works() const override;
  Ticket Append(StateChange change) override;
  [[nodiscard]] bool Wait(Ticket ticket) override;
  // The log beside the file is then empty.
  void Close() override;

 private:
  struct Statements {
    Statement put_offer, remove_offer, put_proxy, remove_proxy, put_type, remove_type, put_link,
        remove_link, put_attribute, put_number, begin, commit;
  };

  OfferFile(std::string path, Database database, Statements statements);
  base::Status LoadNumbers(TraderState& state);
  base::Status LoadTypes(TraderState& state);
  base::Status LoadOffers(TraderState& state);
  base::Status LoadProxies(TraderState& state);
  base::Status LoadLinks(TraderState& state);
  base::Status LoadAttributes(TraderState& state);

  void Write();
  base::Status WriteWithPatience(const std::vector<StateChange>& changes);
  base::Status WriteAll(const std::vector<StateChange>& changes);
  base::Status Apply(const OfferStored& change);
  base::Status PutProxy(const Offer& offer);
  base::Status Apply(const OffersRemoved& change);
  base::Status Apply(const TypeStored& change);
  base::Status Apply(const TypeRemoved& change);
  base::Status Apply(const LinkStored& change);
  base::Status Apply(const LinkRemoved& change);
  base::Status Apply(const AttributesStored& change);
  base::Status PutNumber(std::string_view name, std::uint64_t value);

  const std::string path_;
  Database database_;
  Statements statements_;

  mutable base::Mutex mutex_;
  base::ConditionVariable appended_;
  base::ConditionVariable written_;
  std::vector<StateChange> waiting_ GSV_GUARDED_BY(mutex_);
  Ticket last_appended_ GSV_GUARDED_BY(mutex_) = 0;
  Ticket last_written_ GSV_GUARDED_BY(mutex_) = 0;
  bool works_ GSV_GUARDED_BY(mutex_) = true;
  bool ending_ GSV_GUARDED_BY(mutex_) = false;
  std::thread writer_;  // last: it uses the others
};

}  // namespace gsv::broker
