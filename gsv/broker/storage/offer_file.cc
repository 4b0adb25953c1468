#include "gsv/broker/storage/offer_file.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <new>
#include <utility>

#include "gsv/broker/encoding/record_encoding.h"
#include "gsv/broker/storage/offer_file_schema.h"
#include "gsv/broker/trader/attribute_texts.h"

namespace gsv::broker {

namespace {

FollowOption ToFollowOption(std::int64_t value) {
  return static_cast<FollowOption>(std::clamp<std::int64_t>(value, 0, 2));
}

}  // namespace

base::Result<std::unique_ptr<OfferFile>> OfferFile::Open(const std::string& path,
                                                         std::uint32_t stem) {
  auto database = OpenOfferDatabase(path, stem);
  if (!database) return base::Fail(database.error());
  Statements statements;
  const std::pair<Statement*, std::string_view> texts[] = {
      {&statements.put_offer, "INSERT OR REPLACE INTO offer VALUES (?, ?, ?, ?)"},
      {&statements.remove_offer, "DELETE FROM offer WHERE number = ?"},
      {&statements.put_proxy, "INSERT OR REPLACE INTO proxy VALUES (?, ?, ?, ?, ?, ?, ?)"},
      {&statements.remove_proxy, "DELETE FROM proxy WHERE number = ?"},
      {&statements.put_type, "INSERT OR REPLACE INTO service_type VALUES (?, ?)"},
      {&statements.remove_type, "DELETE FROM service_type WHERE name = ?"},
      {&statements.put_link, "INSERT OR REPLACE INTO link VALUES (?, ?, ?, ?)"},
      {&statements.remove_link, "DELETE FROM link WHERE name = ?"},
      {&statements.put_attribute, "INSERT OR REPLACE INTO attribute VALUES (?, ?)"},
      {&statements.put_number, "UPDATE broker SET value = max(value, ?2) WHERE name = ?1"},
      {&statements.begin, "BEGIN"},
      {&statements.commit, "COMMIT"}};
  for (const auto& [statement, text] : texts) {
    auto prepared = database->Prepare(text);
    if (!prepared) {
      return base::Fail(base::ErrorCode::kCorrupt,
                        "the file is damaged (" + prepared.error().message + ")", path);
    }
    *statement = std::move(*prepared);
  }
  return std::unique_ptr<OfferFile>(
      new OfferFile(path, std::move(*database), std::move(statements)));
}

OfferFile::OfferFile(std::string path, Database database, Statements statements)
    : path_(std::move(path)),
      database_(std::move(database)),
      statements_(std::move(statements)),
      writer_([this] { Write(); }) {}

void OfferFile::Close() {
  {
    const base::MutexLock lock(mutex_);
    ending_ = true;
  }
  appended_.notify_one();
  if (!writer_.joinable()) return;
  writer_.join();
  const base::MutexLock lock(mutex_);
  works_ = false;
  waiting_.clear();
  written_.notify_all();
  // if this fails, the next Open() empties the log
  (void)database_.Run("PRAGMA wal_checkpoint(TRUNCATE)");
}

base::Result<TraderState> OfferFile::Load() {
  TraderState state;
  for (const auto load :
       {&OfferFile::LoadNumbers, &OfferFile::LoadTypes, &OfferFile::LoadOffers,
        &OfferFile::LoadProxies, &OfferFile::LoadLinks, &OfferFile::LoadAttributes}) {
    if (auto loaded = (this->*load)(state); !loaded) {
      return base::Fail(base::ErrorCode::kCorrupt, loaded.error().message, path_);
    }
  }
  return state;
}

base::Status OfferFile::LoadNumbers(TraderState& state) {
  auto rows = database_.Prepare("SELECT name, value FROM broker");
  if (!rows) return base::Fail(rows.error());
  while (true) {
    const auto row = rows->Next();
    if (!row) return base::Fail(row.error());
    if (!*row) return {};
    const std::string name = rows->Bytes(0);
    const auto value = static_cast<std::uint64_t>(rows->Integer(1));
    if (name == kStem) state.stem = static_cast<std::uint32_t>(value);
    if (name == kNextNumber) state.next_number = value;
    if (name == kNextIncarnation) state.next_incarnation = value;
  }
}

base::Status OfferFile::LoadTypes(TraderState& state) {
  auto rows = database_.Prepare("SELECT name, description FROM service_type");
  if (!rows) return base::Fail(rows.error());
  while (true) {
    const auto row = rows->Next();
    if (!row) return base::Fail(row.error());
    if (!*row) return {};
    auto type = DecodeServiceType(rows->Bytes(0), rows->Bytes(1));
    if (!type) return base::Fail(type.error());
    state.types.push_back(std::move(*type));
  }
}

base::Status OfferFile::LoadOffers(TraderState& state) {
  auto rows = database_.Prepare("SELECT number, type, reference, properties FROM offer");
  if (!rows) return base::Fail(rows.error());
  while (true) {
    const auto row = rows->Next();
    if (!row) return base::Fail(row.error());
    if (!*row) return {};
    auto properties = DecodeProperties(rows->Bytes(3));
    if (!properties) return base::Fail(properties.error());
    state.offers.push_back({.number = static_cast<std::uint64_t>(rows->Integer(0)),
                            .type = rows->Bytes(1),
                            .reference = rows->Bytes(2),
                            .properties = std::move(*properties)});
  }
}

base::Status OfferFile::LoadProxies(TraderState& state) {
  auto rows = database_.Prepare(
      "SELECT number, type, target, properties, if_match_all, recipe, policies FROM proxy");
  if (!rows) return base::Fail(rows.error());
  while (true) {
    const auto row = rows->Next();
    if (!row) return base::Fail(row.error());
    if (!*row) return {};
    auto properties = DecodeProperties(rows->Bytes(3));
    if (!properties) return base::Fail(properties.error());
    if (auto policies = DecodePolicies(rows->Bytes(6)); !policies) {
      return base::Fail(policies.error());
    }
    state.offers.push_back(
        {.number = static_cast<std::uint64_t>(rows->Integer(0)),
         .type = rows->Bytes(1),
         .reference = rows->Bytes(2),
         .properties = std::move(*properties),
         .proxy = std::make_shared<const ProxyPart>(ProxyPart{.if_match_all = rows->Integer(4) != 0,
                                                              .recipe = rows->Bytes(5),
                                                              .policies = rows->Bytes(6)})});
  }
}

base::Status OfferFile::LoadLinks(TraderState& state) {
  auto rows = database_.Prepare("SELECT name, target, def_pass_on, limiting FROM link");
  if (!rows) return base::Fail(rows.error());
  while (true) {
    const auto row = rows->Next();
    if (!row) return base::Fail(row.error());
    if (!*row) return {};
    state.links.push_back({.name = rows->Bytes(0),
                           .target = rows->Bytes(1),
                           .def_pass_on = ToFollowOption(rows->Integer(2)),
                           .limiting = ToFollowOption(rows->Integer(3))});
  }
}

base::Status OfferFile::LoadAttributes(TraderState& state) {
  auto rows = database_.Prepare("SELECT name, value FROM attribute");
  if (!rows) return base::Fail(rows.error());
  while (true) {
    const auto row = rows->Next();
    if (!row) return base::Fail(row.error());
    if (!*row) return {};
    SetAttribute(rows->Bytes(0), rows->Bytes(1), state.attributes);
  }
}

base::Status OfferFile::LimitPages(int pages) {
  return database_.Run("PRAGMA max_page_count = " + std::to_string(pages));
}

bool OfferFile::works() const {
  const base::MutexLock lock(mutex_);
  return works_;
}

Journal::ChangeNumber OfferFile::Append(StateChange change) {
  ChangeNumber number = 0;
  {
    const base::MutexLock lock(mutex_);
    if (works_) waiting_.push_back(std::move(change));
    number = ++last_appended_;
  }
  appended_.notify_one();
  return number;
}

bool OfferFile::Wait(ChangeNumber number) {
  base::MutexLock lock(mutex_);
  written_.wait(lock, [&]() GSV_REQUIRES(mutex_) { return last_written_ >= number || !works_; });
  return last_written_ >= number;
}

void OfferFile::Write() {
  base::MutexLock lock(mutex_);
  while (true) {
    appended_.wait(lock, [this]() GSV_REQUIRES(mutex_) { return ending_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const std::vector<StateChange> changes = std::exchange(waiting_, {});
    const ChangeNumber last = last_appended_;
    lock.unlock();
    const base::Status written = WriteWithRetries(changes);
    lock.lock();
    if (written) {
      last_written_ = last;
    } else {
      works_ = false;
      waiting_.clear();
      std::fprintf(stderr,
                   "%s: cannot store offers (%s). Queries still work; changes are refused until "
                   "the broker is restarted\n",
                   path_.c_str(), written.error().message.c_str());
    }
    written_.notify_all();
  }
}

// Retries after bad_alloc, because other threads may use up the limited address space for a moment.
base::Status OfferFile::WriteWithRetries(const std::vector<StateChange>& changes) {
  constexpr int kTries = 50;
  constexpr std::chrono::milliseconds kPause(100);
  for (int tries = 1;; ++tries) {
    try {
      return WriteAll(changes);
    } catch (const std::bad_alloc&) {
      (void)database_.Run("ROLLBACK");
      if (tries == kTries) return base::Fail(base::ErrorCode::kUnavailable, "out of memory");
      std::this_thread::sleep_for(kPause);
    }
  }
}

base::Status OfferFile::WriteAll(const std::vector<StateChange>& changes) {
  if (auto ok = statements_.begin.Run(); !ok) return ok;
  for (const StateChange& change : changes) {
    const base::Status ok = std::visit([this](const auto& each) { return Apply(each); }, change);
    if (ok) continue;
    (void)database_.Run("ROLLBACK");  // the error of the change is returned, not one of ROLLBACK
    return ok;
  }
  return statements_.commit.Run();
}

base::Status OfferFile::Apply(const OfferStored& change) {
  const Offer& offer = *change.offer;
  if (offer.proxy != nullptr) return PutProxy(offer);
  statements_.put_offer.Bind(1, static_cast<std::int64_t>(offer.number))
      .Bind(2, *offer.type)
      .Bind(3, offer.reference)
      .BindBlob(4, EncodeProperties(offer.properties));
  if (auto ok = statements_.put_offer.Run(); !ok) return ok;
  return PutNumber(kNextNumber, offer.number + 1);
}

base::Status OfferFile::PutProxy(const Offer& offer) {
  statements_.put_proxy.Bind(1, static_cast<std::int64_t>(offer.number))
      .Bind(2, *offer.type)
      .Bind(3, offer.reference)
      .BindBlob(4, EncodeProperties(offer.properties))
      .Bind(5, std::int64_t{offer.proxy->if_match_all})
      .Bind(6, offer.proxy->recipe)
      .BindBlob(7, offer.proxy->policies);
  if (auto ok = statements_.put_proxy.Run(); !ok) return ok;
  return PutNumber(kNextNumber, offer.number + 1);
}

base::Status OfferFile::Apply(const OffersRemoved& change) {
  for (const std::uint64_t number : change.numbers) {
    for (Statement* remove : {&statements_.remove_offer, &statements_.remove_proxy}) {
      if (auto ok = remove->Bind(1, static_cast<std::int64_t>(number)).Run(); !ok) return ok;
    }
  }
  return {};
}

base::Status OfferFile::Apply(const TypeStored& change) {
  statements_.put_type.Bind(1, change.type.name).BindBlob(2, EncodeServiceType(change.type));
  if (auto ok = statements_.put_type.Run(); !ok) return ok;
  return PutNumber(kNextIncarnation, change.type.incarnation + 1);
}

base::Status OfferFile::Apply(const TypeRemoved& change) {
  return statements_.remove_type.Bind(1, change.name).Run();
}

base::Status OfferFile::Apply(const LinkStored& change) {
  return statements_.put_link.Bind(1, change.link.name)
      .Bind(2, change.link.target)
      .Bind(3, static_cast<std::int64_t>(change.link.def_pass_on))
      .Bind(4, static_cast<std::int64_t>(change.link.limiting))
      .Run();
}

base::Status OfferFile::Apply(const LinkRemoved& change) {
  return statements_.remove_link.Bind(1, change.name).Run();
}

base::Status OfferFile::Apply(const AttributesStored& change) {
  for (const auto& [name, value] : AttributeTexts(change.attributes)) {
    statements_.put_attribute.Bind(1, name).BindBlob(2, value);
    if (auto ok = statements_.put_attribute.Run(); !ok) return ok;
  }
  return {};
}

base::Status OfferFile::PutNumber(std::string_view name, std::uint64_t value) {
  return statements_.put_number.Bind(1, name).Bind(2, static_cast<std::int64_t>(value)).Run();
}

}  // namespace gsv::broker
