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

  // Reads the stored state from the file and returns it. Call it before the first Append().
  // Errors  kCorrupt.
  [[nodiscard]] base::Result<TraderState> Load();

  // Limits the file to `pages` pages of 4 KiB each. A change that does not fit is not stored.
  // Call it before the first Append().
  [[nodiscard]] base::Status LimitPages(int pages);

  // Whether changes can be stored: false after a failed write and after Close().
  bool works() const override;
  ChangeNumber Append(StateChange change) override;
  [[nodiscard]] bool Wait(ChangeNumber number) override;
  // Also empties the write-ahead log.
  void Close() override;

 private:
  // The prepared statements, named after the changes that they write. `put_number` writes a row of
  // the table `broker`.
  struct Statements {
    Statement put_offer, remove_offer, put_proxy, remove_proxy, put_type, remove_type, put_link,
        remove_link, put_attribute, put_number, begin, commit;
  };

  OfferFile(std::string path, Database database, Statements statements);
  // Each function reads one part of the state. LoadNumbers() reads the table `broker`, which stores
  // the stem, the number of the next offer and the incarnation of the next type.
  base::Status LoadNumbers(TraderState& state);
  base::Status LoadTypes(TraderState& state);
  base::Status LoadOffers(TraderState& state);
  base::Status LoadProxies(TraderState& state);
  base::Status LoadLinks(TraderState& state);
  base::Status LoadAttributes(TraderState& state);

  void Write();  // the function of writer_
  // Calls WriteAll(), and calls it again for some seconds while memory is short.
  base::Status WriteWithRetries(const std::vector<StateChange>& changes);
  // Writes the changes in one transaction.
  base::Status WriteAll(const std::vector<StateChange>& changes);
  // Each function writes one change, or a part of a change, to the tables.
  base::Status Apply(const OfferStored& change);
  base::Status PutProxy(const Offer& offer);
  base::Status Apply(const OffersRemoved& change);
  base::Status Apply(const TypeStored& change);
  base::Status Apply(const TypeRemoved& change);
  base::Status Apply(const LinkStored& change);
  base::Status Apply(const LinkRemoved& change);
  base::Status Apply(const AttributesStored& change);
  // Writes a row of the table `broker`, see offer_file_schema.h.
  base::Status PutNumber(std::string_view name, std::uint64_t value);

  const std::string path_;
  Database database_;
  Statements statements_;

  mutable base::Mutex mutex_;
  base::ConditionVariable appended_;  // notified by Append() and Close()
  base::ConditionVariable written_;   // notified after a write, a failed write, and Close()
  std::vector<StateChange> waiting_ GSV_GUARDED_BY(mutex_);  // changes that are not written yet
  ChangeNumber last_appended_ GSV_GUARDED_BY(mutex_) = 0;
  ChangeNumber last_written_ GSV_GUARDED_BY(mutex_) = 0;
  bool works_ GSV_GUARDED_BY(mutex_) = true;    // false after a failed write, and after Close()
  bool ending_ GSV_GUARDED_BY(mutex_) = false;  // set by Close(); the writer then ends
  std::thread writer_;  // declared last, because the thread uses the other members when it starts
};

}  // namespace gsv::broker
