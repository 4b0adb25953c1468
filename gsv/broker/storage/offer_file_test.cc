#include "gsv/broker/storage/offer_file.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "gsv/base/temporary_folder.h"
#include "gsv/broker/encoding/record_encoding.h"
#include "gsv/broker/testing/broker_fixture.h"
#include "gsv/broker/trader/trader.h"

namespace gsv::broker {
namespace {

constexpr std::uint32_t kOwnStem = 0x1234abcd;

class OfferFileTest : public testing::Test {
 protected:
  OfferFileTest() { TestOrb(); }

  std::string Path() const { return folder_.path() / "broker.db"; }

  // Returns a trader with the state that an earlier trader left in the file.
  std::unique_ptr<Trader> Reopen(std::uint32_t stem = kOwnStem) const {
    auto trader = std::make_unique<Trader>(TraderLimits{}, stem, 1);
    auto file = OfferFile::Open(Path(), stem);
    EXPECT_TRUE(file) << file.error().Sentence();
    auto state = (*file)->Load();
    EXPECT_TRUE(state) << state.error().Sentence();
    EXPECT_TRUE(trader->Restore(std::move(*state), std::move(*file)));
    return trader;
  }

  // Returns the error of opening or loading the file.
  base::Error OpenError() const {
    auto file = OfferFile::Open(Path(), kOwnStem);
    if (!file) return file.error();
    auto state = (*file)->Load();
    EXPECT_FALSE(state);
    return state ? base::Error{} : state.error();
  }

  const base::TemporaryFolder folder_ = base::TemporaryFolder::Make("gsv-test").value();
};

TEST_F(OfferFileTest, KeepsEveryKindOfValue) {
  const std::vector<Property> properties = {{"boolean", Value::Boolean(true)},
                                            {"char", Value::Char('x')},
                                            {"double", Value::Double(0.1)},
                                            {"float", Value::Float(0.1f)},
                                            {"long", Value::Long(-7)},
                                            {"short", Value::Short(-8)},
                                            {"string", Value::String("o'clock")},
                                            {"strings", Value::Strings({"a", "", "c"})},
                                            {"ulong", Value::ULong(4'000'000'000u)},
                                            {"ushort", Value::UShort(65'535)}};
  auto trader = Reopen();
  ASSERT_TRUE(trader->AddType({.name = "Robot"}));
  const auto id = trader->Export("Robot", "IOR:00", properties);
  ASSERT_TRUE(id);
  trader = nullptr;

  const auto offer = Reopen()->Describe(*id);
  ASSERT_TRUE(offer);
  EXPECT_EQ(*(*offer)->type, "Robot");
  EXPECT_EQ((*offer)->reference, "IOR:00");
  ASSERT_EQ((*offer)->properties.size(), properties.size());
  for (std::size_t i = 0; i < properties.size(); ++i) {
    EXPECT_EQ((*offer)->properties[i].name, properties[i].name);
    EXPECT_EQ((*offer)->properties[i].value, properties[i].value) << properties[i].name;
  }
}

TEST_F(OfferFileTest, KeepsTypesWithAllTheirMembers) {
  auto trader = Reopen();
  ASSERT_TRUE(trader->AddType({.name = "Vehicle",
                               .interface_name = "IDL:acme/Vehicle:1.0",
                               .properties = {{"speed",
                                               {.scalar = Scalar::kDouble, .sequence = true},
                                               PropertyMode::kMandatoryReadonly}}}));
  ASSERT_TRUE(trader->AddType({.name = "Gone"}));
  ASSERT_TRUE(trader->AddType(
      {.name = "Car", .interface_name = "IDL:acme/Car:1.0", .super_types = {"Vehicle"}}));
  ASSERT_TRUE(trader->AddType({.name = "Last"}));
  ASSERT_TRUE(trader->MaskType("Car"));
  ASSERT_TRUE(trader->RemoveType("Gone"));
  ASSERT_TRUE(trader->RemoveType("Last"));
  trader = nullptr;

  trader = Reopen();
  EXPECT_EQ(trader->ListTypes(std::nullopt), (std::vector<std::string>{"Car", "Vehicle"}));
  EXPECT_EQ(trader->NextIncarnation(), 5u) << "that of a removed type is not given again";
  const ServiceType car = trader->FullyDescribeType("Car").value();
  EXPECT_TRUE(car.masked);
  EXPECT_EQ(car.incarnation, 3u);
  EXPECT_EQ(car.super_types, std::vector<std::string>{"Vehicle"});
  ASSERT_EQ(car.properties.size(), 1u);
  EXPECT_EQ(car.properties[0].type, (PropertyType{.scalar = Scalar::kDouble, .sequence = true}));
  EXPECT_EQ(car.properties[0].mode, PropertyMode::kMandatoryReadonly);
}

TEST_F(OfferFileTest, KeepsModifiedOffersAndRemovesWithdrawnOnes) {
  auto trader = Reopen();
  ASSERT_TRUE(trader->AddType({.name = "Robot"}));
  const std::string kept = *trader->Export("Robot", "IOR:01", {{"n", Value::Long(1)}});
  const std::string matching = *trader->Export("Robot", "IOR:02", {{"n", Value::Long(2)}});
  const std::string last = *trader->Export("Robot", "IOR:03", {{"n", Value::Long(3)}});
  ASSERT_TRUE(trader->Modify(kept, {.set = {{"n", Value::Long(10)}}}));
  ASSERT_TRUE(trader->WithdrawMatching("Robot", "n == 2"));
  ASSERT_TRUE(trader->Withdraw(last));
  trader = nullptr;

  trader = Reopen(kOwnStem + 1);
  EXPECT_EQ(trader->OfferIds(), std::vector<std::string>{kept});
  EXPECT_EQ(*trader->Describe(kept).value()->properties.Find("n"), Value::Long(10));
  const std::string next = *trader->Export("Robot", "IOR:04", {});
  EXPECT_GT(next, last) << "the id of a withdrawn offer never names another";
  EXPECT_EQ(next.substr(0, 9), kept.substr(0, 9)) << "the stem is that of the file";
}

TEST_F(OfferFileTest, KeepsLinksAndAttributes) {
  auto trader = Reopen();
  const TraderLink kept{.name = "kept",
                        .target = "IOR:00",
                        .def_pass_on = FollowOption::kLocalOnly,
                        .limiting = FollowOption::kIfNoLocal};
  ASSERT_TRUE(trader->AddLink(kept));
  ASSERT_TRUE(trader->AddLink({.name = "removed", .target = "IOR:01"}));
  ASSERT_TRUE(trader->ModifyLink("kept", FollowOption::kIfNoLocal, FollowOption::kAlways));
  ASSERT_TRUE(trader->RemoveLink("removed"));
  ASSERT_TRUE(trader->ChangeAttributes([](TraderAttributes& attributes) {
    attributes.max_list = 9;
    attributes.request_id_stem = std::string("a\0b", 3);
  }));
  trader = nullptr;
  trader = Reopen();
  ASSERT_EQ(trader->links().size(), 1u);
  const TraderLink link = trader->links()[0];
  EXPECT_EQ(link.name, "kept");
  EXPECT_EQ(link.target, "IOR:00");
  EXPECT_EQ(link.def_pass_on, FollowOption::kIfNoLocal);
  EXPECT_EQ(link.limiting, FollowOption::kAlways);
  EXPECT_EQ(trader->attributes().max_list, 9u);
  EXPECT_EQ(trader->attributes().request_id_stem, std::string("a\0b", 3));
}

TEST_F(OfferFileTest, KeepsProxies) {
  auto trader = Reopen();
  ASSERT_TRUE(trader->AddType({.name = "Robot"}));
  const std::string policies = EncodePolicies(CosTrading::PolicySeq());
  const ProxyPart part{.if_match_all = true, .recipe = "n == $(n)", .policies = policies};
  const std::string kept = *trader->ExportProxy("Robot", "IOR:00", {{"n", Value::Long(7)}}, part);
  const std::string gone = *trader->ExportProxy("Robot", "IOR:01", {{"n", Value::Long(7)}}, part);
  ASSERT_TRUE(trader->WithdrawProxy(gone));
  trader = nullptr;
  trader = Reopen();
  EXPECT_EQ(trader->ProxyIds(), std::vector<std::string>{kept});
  EXPECT_TRUE(trader->OfferIds().empty());
  const OfferPtr proxy = trader->DescribeProxy(kept).value();
  EXPECT_EQ(*proxy->type, "Robot");
  EXPECT_EQ(proxy->reference, "IOR:00");
  EXPECT_EQ(*proxy->properties.Find("n"), Value::Long(7));
  EXPECT_TRUE(proxy->proxy->if_match_all);
  EXPECT_EQ(proxy->proxy->recipe, "n == $(n)");
  EXPECT_EQ(proxy->proxy->policies, policies);
  EXPECT_GT(*trader->Export("Robot", "IOR:02", {}), gone);
}

// The file has format 1, which had neither links nor attributes.
TEST_F(OfferFileTest, UpgradesAFileOfAnEarlierFormat) {
  auto trader = Reopen();
  ASSERT_TRUE(trader->AddType({.name = "Robot"}));
  const std::string id = *trader->Export("Robot", "IOR:00", {});
  trader = nullptr;
  ASSERT_TRUE(Database::Open(Path())->Run(
      "DROP TABLE link; DROP TABLE proxy; DROP TABLE attribute; PRAGMA user_version = 1"));
  trader = Reopen();
  EXPECT_TRUE(trader->Describe(id));
  ASSERT_TRUE(trader->AddLink({.name = "kept", .target = "IOR:00"}));
  trader = nullptr;
  EXPECT_EQ(Reopen()->links().size(), 1u);
}

TEST_F(OfferFileTest, RefusesChangesAfterItIsClosed) {
  auto trader = Reopen();
  ASSERT_TRUE(trader->AddType({.name = "Robot"}));
  const auto id = trader->Export("Robot", "IOR:00", {});
  ASSERT_TRUE(id);
  trader->Close();
  trader->Close();
  const auto refused = trader->Export("Robot", "IOR:01", {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().refusal, Refusal::kNotStored);
  EXPECT_TRUE(trader->Describe(*id));  // the trader still answers queries
  trader = nullptr;
  EXPECT_TRUE(Reopen()->Describe(*id));
}

TEST_F(OfferFileTest, IsLockedAgainstASecondBroker) {
  const auto first = OfferFile::Open(Path(), kOwnStem);
  ASSERT_TRUE(first);
  EXPECT_EQ(
      OpenError().Sentence(),
      Path() + ": another broker is using this file; stop it, or choose another file with --data");
}

TEST_F(OfferFileTest, RejectsFilesThatAreNotABrokers) {
  std::ofstream(Path()) << "These are the notes of a friend, and nothing for a broker to read. "
                           "They go on for a while so that they are longer than a header.";
  EXPECT_EQ(OpenError().message,
            "this is not the file of a broker; choose another with --data, or use --memory");
  std::filesystem::remove(Path());

  ASSERT_TRUE(Database::Open(Path())->Run("CREATE TABLE recipes (name TEXT)"));
  EXPECT_EQ(OpenError().message,
            "this is the database of another program; choose another file with --data");
  std::filesystem::remove(Path());

  ASSERT_TRUE(OfferFile::Open(Path(), kOwnStem));
  ASSERT_TRUE(Database::Open(Path())->Run("PRAGMA user_version = 99"));
  EXPECT_EQ(
      OpenError().message,
      "the file has format 99, but this gsv reads format 2; use the gsv that wrote it, or choose "
      "another file with --data");

  EXPECT_FALSE(OfferFile::Open(folder_.path() / "absent" / "broker.db", kOwnStem));
}

TEST_F(OfferFileTest, ReportsDamage) {
  auto trader = Reopen();
  ASSERT_TRUE(trader->AddType({.name = "Robot"}));
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(trader->Export("Robot", std::string(500, 'x'), {}));
  trader = nullptr;
  std::fstream file(Path(), std::ios::in | std::ios::out | std::ios::binary);
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(Path()));
  for (std::streamoff at = 4096; at + 64 < size; at += 1024) {
    file.seekp(at) << std::string(64, '\xff');
  }
  file.close();
  const base::Error error = OpenError();
  EXPECT_EQ(error.code, base::ErrorCode::kCorrupt);
  EXPECT_TRUE(error.message.starts_with("the file is damaged")) << error.message;
}

TEST_F(OfferFileTest, ReportsARecordThatCannotBeDecoded) {
  auto trader = Reopen();
  ASSERT_TRUE(trader->AddType({.name = "Robot"}));
  ASSERT_TRUE(trader->Export("Robot", "IOR:00", {{"n", Value::Long(1)}}));
  trader = nullptr;
  ASSERT_TRUE(Database::Open(Path())->Run("UPDATE offer SET properties = x'01ffffffff'"));
  EXPECT_EQ(OpenError().Sentence(), Path() + ": an offer cannot be decoded (MARSHAL)");
}

// The disk is full: SQLite cannot enlarge the file.
TEST_F(OfferFileTest, RefusesChangesThatItCannotStoreAndStillAnswersQueries) {
  auto trader = Reopen();
  ASSERT_TRUE(trader->AddType({.name = "Robot"}));
  const std::string kept = *trader->Export("Robot", "IOR:00", {});
  trader = nullptr;

  auto file = OfferFile::Open(Path(), kOwnStem);
  ASSERT_TRUE(file);
  auto state = (*file)->Load();
  ASSERT_TRUE((*file)->LimitPages(1));
  Trader limited(TraderLimits{}, kOwnStem, 1);
  ASSERT_TRUE(limited.Restore(std::move(*state), std::move(*file)));
  testing::internal::CaptureStderr();
  TradingResult<std::string> refused;
  for (int i = 0; i < 1000 && refused; ++i) {
    refused = limited.Export("Robot", std::string(5000, 'x'), {});
  }
  const std::string said = testing::internal::GetCapturedStderr();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().refusal, Refusal::kNotStored);
  EXPECT_EQ(limited.Withdraw(kept).error().refusal, Refusal::kNotStored);
  EXPECT_TRUE(limited.Describe(kept)) << "what is refused changes nothing";
  EXPECT_EQ(said.find(Path() + ": cannot store offers (database or disk is full)"), 0u) << said;
}

}  // namespace
}  // namespace gsv::broker
