#include "gsv/gateway/live/live_operations.h"

#include <algorithm>
#include <future>

#include <gtest/gtest.h>

#include "gsv/gateway/testing/scripted_simulation.h"
#include "gsv/messages/cdr.h"

namespace gsv::gateway {
namespace {

using testing::ScriptedSimulation;

// Starts and stops a single recording, whose path is /tmp/arena.mcap.
class OneRecording final : public RecordingSwitch {
 public:
  Totals totals() override { return {}; }
  base::Status Record(const std::shared_ptr<simulation::Simulation>& simulation) override {
    if (is_recording_) {
      return base::Fail(base::ErrorCode::kInvalidArgument, "it is being recorded");
    }
    recorded_ = simulation->specification().name;
    is_recording_ = true;
    return {};
  }
  base::Status StopRecording(const std::string& simulation) override {
    EXPECT_EQ(simulation, recorded_);
    is_recording_ = false;
    return {};
  }
  State RecordingOf(const std::string& simulation) override {
    if (simulation != recorded_) return {};
    return {is_recording_, "/tmp/arena.mcap", 0, 0, 0};
  }

 private:
  std::string recorded_;
  bool is_recording_ = false;
};

struct Reply {
  bool success = false;
  std::string message;
};

class LiveOperationsTest : public ::testing::Test {
 protected:
  void TearDown() override { workers_.Stop(); }

  // Calls the service with this name. Returns its answer, or that there is no such service.
  Reply Call(LiveOperations& operations, const std::string& name) const {
    for (const foxglove::Service& service : operations.services()) {
      if (service.name != name) continue;
      std::promise<std::vector<std::byte>> answered;
      operations.Call({service.id, 1, "cdr", ""}, [&](const auto& response) {
        answered.set_value(response.value_or(std::vector<std::byte>()));
      });
      const std::vector<std::byte> bytes = answered.get_future().get();
      messages::CdrReader reader(bytes);
      Reply reply;
      reader.Read(reply.success);
      reader.Read(reply.message);
      EXPECT_TRUE(reader.Finish());
      return reply;
    }
    return {false, "there is no service " + name};
  }

  foxglove::ParameterValue ValueOf(const LiveOperations& operations,
                                   const std::string& name) const {
    for (const foxglove::Parameter& parameter : operations.parameters()) {
      if (parameter.name == name) return parameter.value;
    }
    return {};
  }

  std::string Refusal(LiveOperations& operations, const foxglove::Parameter& parameter) const {
    const base::Status set = operations.Set(parameter);
    return set ? "" : set.error().Sentence();
  }

  WorkerPool workers_{1, 8};
  OneRecording recordings_;
  std::shared_ptr<ScriptedSimulation> simulation_ =
      std::make_shared<ScriptedSimulation>("arena", 1);
};

TEST_F(LiveOperationsTest, SetsTheRealTimeFactor) {
  LiveOperations operations(simulation_, workers_, nullptr);
  EXPECT_EQ(ValueOf(operations, "/gsv/gravity_z_m_s2"), foxglove::ParameterValue(-9.8));
  EXPECT_EQ(ValueOf(operations, "/gsv/real_time_factor"), foxglove::ParameterValue(1.0));
  EXPECT_TRUE(operations.Set({"/gsv/real_time_factor", 2.5}));
  EXPECT_EQ(simulation_->real_time_factor(), 2.5);
  EXPECT_EQ(ValueOf(operations, "/gsv/real_time_factor"), foxglove::ParameterValue(2.5));
  EXPECT_TRUE(operations.Set({"/gsv/factor", 3.5})) << "the former name";
  EXPECT_EQ(ValueOf(operations, "/gsv/factor"), foxglove::ParameterValue(3.5));
  EXPECT_TRUE(operations.Set({"/gsv/factor", 2.5}));
}

TEST_F(LiveOperationsTest, AnInvalidParameterIsRefusedWithTheReason) {
  LiveOperations operations(simulation_, workers_, nullptr);
  EXPECT_EQ(Refusal(operations, {"/gsv/real_time_factor", std::string("fast")}),
            "the parameter '/gsv/real_time_factor' must be a number");
  EXPECT_EQ(Refusal(operations, {"/gsv/factor", -1.0}), "the factor must be above 0");
  EXPECT_EQ(Refusal(operations, {"/gsv/seed", 1.0}),
            "the parameter '/gsv/seed' cannot be changed while a simulation runs");
  EXPECT_EQ(Refusal(operations, {"/gsv/colour", true}), "there is no parameter '/gsv/colour'");
  EXPECT_EQ(simulation_->real_time_factor(), 1);
  simulation_.reset();
  EXPECT_EQ(Refusal(operations, {"/gsv/factor", 1.0}), "the simulation was removed");
}

TEST_F(LiveOperationsTest, StartsAndStopsARecording) {
  LiveOperations operations(simulation_, workers_, &recordings_);
  EXPECT_EQ(ValueOf(operations, "/gsv/recording"), foxglove::ParameterValue(false));
  const Reply started = Call(operations, "/gsv/start_recording");
  EXPECT_TRUE(started.success);
  EXPECT_EQ(started.message, "/tmp/arena.mcap");
  EXPECT_EQ(ValueOf(operations, "/gsv/recording"), foxglove::ParameterValue(true));
  const Reply again = Call(operations, "/gsv/start_recording");
  EXPECT_FALSE(again.success);
  EXPECT_EQ(again.message, "it is being recorded");
  EXPECT_TRUE(Call(operations, "/gsv/stop_recording").success);
  EXPECT_EQ(ValueOf(operations, "/gsv/recording"), foxglove::ParameterValue(false));
}

TEST_F(LiveOperationsTest, AServerWithoutRecordingHasNoSuchService) {
  LiveOperations operations(simulation_, workers_, nullptr);
  EXPECT_EQ(Call(operations, "/gsv/start_recording").message,
            "there is no service /gsv/start_recording");
  EXPECT_EQ(ValueOf(operations, "/gsv/recording"), foxglove::ParameterValue());
  EXPECT_TRUE(Call(operations, "/gsv/start").success);
}

}  // namespace
}  // namespace gsv::gateway
