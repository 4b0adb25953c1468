// Tests dynamic properties over TCP. This process evaluates them.
#include <atomic>
#include <condition_variable>
#include <mutex>

#include <COS/CosTradingDynamic.hh>

#include "gsv/broker/testing/broker_fixture.h"

namespace gsv::broker {
namespace {

// A service that returns the double `value`. The test can make it fail, return a string or hang
// instead.
class Evaluator : public POA_CosTradingDynamic::DynamicPropEval {
 public:
  enum class Mood { kAnswer, kFail, kWrongType, kHang };

  CORBA::Any* evalDP(const char* name, CORBA::TypeCode_ptr type, const CORBA::Any& info) override {
    ++calls;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return mood_ != Mood::kHang; });
    }
    if (mood_ == Mood::kFail) {
      throw CosTradingDynamic::DPEvalFailure(name, CORBA::TypeCode::_duplicate(type), info);
    }
    CORBA::Any_var any = new CORBA::Any;
    if (mood_ == Mood::kWrongType) {
      any.inout() <<= "fast";
    } else {
      CORBA::Double added = 0;
      info >>= added;
      any.inout() <<= value + added;
    }
    return any._retn();
  }
  void Be(Mood mood) {
    {
      const std::lock_guard lock(mutex_);
      mood_ = mood;
    }
    changed_.notify_all();
  }

  std::atomic<int> calls = 0;
  std::atomic<double> value = 5;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<Mood> mood_ = Mood::kAnswer;
};

class DynamicPropertiesTest : public BrokerFixture {
 public:
  DynamicPropertiesTest() {
    AddType("Robot", {Define("speed", CORBA::_tc_double, Repository::PROP_NORMAL)});
    evaluator_ = new Evaluator;
    reference_ = evaluator_->_this();
  }
  ~DynamicPropertiesTest() override {
    evaluator_->Be(Evaluator::Mood::kAnswer);
    const PortableServer::POA_var poa = evaluator_->_default_POA();
    const PortableServer::ObjectId_var id = poa->servant_to_id(evaluator_);
    poa->deactivate_object(id);
    evaluator_->_remove_ref();
  }

 protected:
  // Returns a property "speed" with the evaluator's value plus `added`.
  CosTrading::PropertySeq Speed(double added = 0, CORBA::TypeCode_ptr type = CORBA::_tc_double) {
    CosTradingDynamic::DynamicProp dynamic;
    dynamic.eval_if = CosTradingDynamic::DynamicPropEval::_duplicate(reference_);
    dynamic.returned_type = CORBA::TypeCode::_duplicate(type);
    dynamic.extra_info <<= added;
    CosTrading::PropertySeq properties;
    properties.length(1);
    properties[0].name = "speed";
    properties[0].value <<= dynamic;
    return properties;
  }
  std::string ExportSpeed(double added = 0) {
    const CORBA::String_var id = register_->_cxx_export(TestService(), "Robot", Speed(added));
    return id.in();
  }
  static double SpeedOf(const CosTrading::Offer& offer) {
    CORBA::Double speed = -1;
    EXPECT_EQ(offer.properties.length(), 1u);
    EXPECT_TRUE(offer.properties[0].value >>= speed);
    return speed;
  }
  static CORBA::Any Boolean(bool value) {
    CORBA::Any any;
    any <<= CORBA::Any::from_boolean(value);
    return any;
  }

  Evaluator* evaluator_ = nullptr;
  CosTradingDynamic::DynamicPropEval_var reference_;
};

TEST_F(DynamicPropertiesTest, AreUsedInConstraintPreferenceAndAnswer) {
  ExportSpeed(1);
  ExportSpeed(3);
  ExportSpeed(2);
  Answer answer = Query("Robot", "speed > 6.5", "max speed");
  ASSERT_EQ(answer.offers->length(), 2u);
  EXPECT_EQ(SpeedOf(answer.offers[0]), 8);
  EXPECT_EQ(SpeedOf(answer.offers[1]), 7);
  EXPECT_EQ(evaluator_->calls, 3) << "each once, for constraint, preference and answer";
}

TEST_F(DynamicPropertiesTest, AreEvaluatedOnlyWhenNeeded) {
  ExportSpeed();
  Lookup::SpecifiedProps none;
  none._d(Lookup::none);
  EXPECT_EQ(Query("Robot", "", "", {}, 9, none).offers->length(), 1u);
  EXPECT_EQ(evaluator_->calls, 0);
}

// The broker of this test caches an answer for a second. So a query may still return the old value
// for some time after the value has changed.
TEST_F(DynamicPropertiesTest, AreCachedForTheirLifetime) {
  ExportSpeed();
  EXPECT_EQ(SpeedOf(Query("Robot").offers[0]), 5);
  evaluator_->value = 6;
  while (SpeedOf(Query("Robot").offers[0]) != 6) {
  }
  EXPECT_EQ(evaluator_->calls, 2);
}

TEST_F(DynamicPropertiesTest, FailedEvaluationMakesTheConstraintFalseAndOmitsTheProperty) {
  // The service raises DPEvalFailure, or answers with a type that it did not declare.
  for (const auto mood : {Evaluator::Mood::kFail, Evaluator::Mood::kWrongType}) {
    evaluator_->Be(mood);
    // The extra information differs, so that no cached value applies.
    const std::string id = ExportSpeed(static_cast<double>(mood));
    EXPECT_EQ(Query("Robot", "speed > 0").offers->length(), 0u);
    EXPECT_EQ(Query("Robot", "not (speed > 0)").offers->length(), 0u);
    EXPECT_EQ(Query("Robot", "exist speed").offers->length(), 0u);
    Answer all = Query("Robot");
    ASSERT_EQ(all.offers->length(), 1u);
    EXPECT_EQ(all.offers[0].properties.length(), 0u);
    register_->withdraw(id.c_str());
  }
}

TEST_F(DynamicPropertiesTest, HangingServiceDelaysAQueryByAtMostItsBudget) {
  evaluator_->Be(Evaluator::Mood::kHang);
  for (int i = 0; i < 20; ++i) ExportSpeed(i);
  Export("Robot", {{"speed", Value::Double(1)}});
  Answer answer = Query("Robot", "speed > 0");
  ASSERT_EQ(answer.offers->length(), 1u);
  EXPECT_EQ(SpeedOf(answer.offers[0]), 1);
  EXPECT_LT(evaluator_->calls, 20) << "the rest is not asked any more";
}

TEST_F(DynamicPropertiesTest, OffersWithDynamicPropertiesCanBeExcluded) {
  ExportSpeed();
  Export("Robot", {{"speed", Value::Double(1)}});
  const auto use = [](bool value) { return Policy("use_dynamic_properties", Boolean(value)); };
  EXPECT_EQ(Query("Robot", "", "", {use(true)}).offers->length(), 2u);
  EXPECT_EQ(Query("Robot", "", "", {use(false)}).offers->length(), 1u);
  EXPECT_TRUE(admin_->set_supports_dynamic_properties(false));
  EXPECT_EQ(Query("Robot", "", "", {use(true)}).offers->length(), 1u);
  EXPECT_FALSE(register_->supports_dynamic_properties());
  EXPECT_STREQ(Raised<CosTrading::PropertyTypeMismatch>([&] { ExportSpeed(); }).prop.name, "speed");
}

TEST_F(DynamicPropertiesTest, AreDescribedUnchanged) {
  const Register::OfferInfo_var info = register_->describe(ExportSpeed(2).c_str());
  const CosTradingDynamic::DynamicProp* dynamic = nullptr;
  ASSERT_TRUE(info->properties[0].value >>= dynamic);
  EXPECT_TRUE(dynamic->eval_if->_is_equivalent(reference_));
  EXPECT_TRUE(dynamic->returned_type->equal(CORBA::_tc_double));
  CORBA::Double added = 0;
  EXPECT_TRUE(dynamic->extra_info >>= added);
  EXPECT_EQ(added, 2);
  EXPECT_EQ(evaluator_->calls, 0);
}

TEST_F(DynamicPropertiesTest, WithdrawingByAConstraintEvaluatesThem) {
  ExportSpeed(1);
  ExportSpeed(2);
  register_->withdraw_using_constraint("Robot", "speed == 6");
  EXPECT_EQ(SpeedOf(Query("Robot").offers[0]), 7);
}

TEST_F(DynamicPropertiesTest, AreCheckedOnExport) {
  EXPECT_STREQ(Raised<CosTrading::PropertyTypeMismatch>([&] {
                 register_->_cxx_export(TestService(), "Robot", Speed(0, CORBA::_tc_string));
               }).prop.name,
               "speed");
  CosTrading::PropertySeq many;
  many.length(9);
  for (CORBA::ULong i = 0; i < many.length(); ++i) {
    many[i] = Speed()[0];
    many[i].name = ("p" + std::to_string(i)).c_str();
  }
  Raised<CORBA::IMP_LIMIT>([&] { register_->_cxx_export(TestService(), "Robot", many); });
}

}  // namespace
}  // namespace gsv::broker
