// Stores the state of a broker in a file, from which the next start restores it.
//
// Format   an SQLite database in WAL mode with synchronous=NORMAL. Acknowledged changes survive the
//          end of the process at any moment. A power failure may lose the last changes, but does
//          not damage the file. See docs/broker.md.
// Threads  it writes on its own thread; all waiting changes become one transaction.
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
  // Opens the file and locks it against other processes. If the file does not exist, it is created,
  // and `stem` becomes part of its offers' ids.
  // Errors  kUnavailable if the file cannot be opened, or another broker uses it. kCorrupt if the
  //         file is damaged, not a broker's, or of a newer version.
  [[nodiscard]] static base::Result<std::unique_ptr<OfferFile>> Open(const std::string& path,
                                                                     std::uint32_t stem);
  ~OfferFile() override { Close(); }

  // Returns the content of the file when it was opened. Call it before the first Append().
  // Errors  kCorrupt.
  [[nodiscard]] base::Result<TraderState> Load();

  // Limits the file to `pages` of 4 KiB. Changes that need more are not stored. Call it before the
  // first Append().
  [[nodiscard]] base::Status LimitPages(int pages);

  bool works() const override;
  ChangeNumber Append(StateChange change) override;
  [[nodiscard]] bool Wait(ChangeNumber number) override;
  // Also empties the write-ahead log.
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

  void Write();  // the function of writer_
  base::Status WriteWithRetries(const std::vector<StateChange>& changes);
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
  ChangeNumber last_appended_ GSV_GUARDED_BY(mutex_) = 0;
  ChangeNumber last_written_ GSV_GUARDED_BY(mutex_) = 0;
  bool works_ GSV_GUARDED_BY(mutex_) = true;
  bool ending_ GSV_GUARDED_BY(mutex_) = false;
  std::thread writer_;  // destroyed first, because it uses the other members
};

}  // namespace gsv::broker
