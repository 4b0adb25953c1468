#include "gsv/gateway/foxglove/client_requests.h"

#include <cmath>

#include <gtest/gtest.h>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/live/command_services.h"
#include "gsv/gateway/testing/recording_client.h"
#include "gsv/messages/cdr.h"
#include "gsv/simulation/commands/command_table.h"

namespace gsv::gateway {
namespace {

using nlohmann::json;
using testing::RecordingClient;

// Operations with a playback at 5 ns, two parameters and one service. Only the parameter /speed can
// be set. The test gives the service's answer.
class FakeOperations final : public Operations {
 public:
  std::vector<foxglove::Service> services() const override {
    return {{1, "/gsv/stop", "std_srvs/srv/Trigger", {}, {}}};
  }
  void Call(const foxglove::ServiceCall&, Answer answer) override {
    answers.push_back(std::move(answer));
  }
  std::vector<foxglove::Parameter> parameters() const override {
    return {{"/name", "arena"}, {"/speed", speed}};
  }
  base::Status Set(const foxglove::Parameter& parameter) override {
    if (parameter.name != "/speed") {
      return base::Fail(base::ErrorCode::kInvalidArgument, parameter.name + " is fixed");
    }
    speed = std::get<double>(parameter.value);
    return {};
  }
  std::optional<foxglove::PlaybackState> playback() const override {
    return foxglove::PlaybackState{{}, 5, static_cast<float>(speed), false, {}};
  }
  base::Status Control(const foxglove::PlaybackControl& request) override {
    speed = request.speed;
    return {};
  }

  std::vector<Answer> answers;
  double speed = 1;
};

class ClientRequestsTest : public ::testing::Test {
 protected:
  std::shared_ptr<RecordingClient> Join(const char* subprotocol = "foxglove.sdk.v1") {
    auto client = std::make_shared<RecordingClient>();
    hub_.Add(client, subprotocol);
    return client;
  }

  void Send(RecordingClient& client, const json& text) {
    EXPECT_TRUE(hub_.Receive(&client, text.dump()));
  }

  void CallStop(RecordingClient& client, char call) {
    const std::string bytes = std::string("\x02\x01\0\0\0", 5) + call + std::string("\0\0\0", 3) +
                              std::string("\x03\0\0\0cdr", 7);
    EXPECT_TRUE(hub_.ReceiveBytes(&client, bytes));
  }

  std::shared_ptr<FakeOperations> operations_ = std::make_shared<FakeOperations>();
  Hub hub_{{"test", {"time"}, {}, "1", foxglove::TimeRange{0, 9}}, [] {}, operations_};
};

TEST_F(ClientRequestsTest, ANewClientGetsTheCapabilities) {
  const auto client = Join();
  ASSERT_EQ(client->texts().size(), 3u);
  EXPECT_EQ(client->texts()[0]["capabilities"],
            json({"time", "connectionGraph", "services", "parameters", "parametersSubscribe",
                  "playbackControl"}));
  EXPECT_EQ(client->texts()[2]["services"][0]["name"], "/gsv/stop");
  ASSERT_EQ(client->answers().size(), 1u);  // the state of the playback
  EXPECT_EQ(client->answers()[0].front(), '\x05');
}

TEST_F(ClientRequestsTest, AClientOfTheOlderProtocolGetsNoPlaybackState) {
  const auto client = Join("foxglove.websocket.v1");
  const json info = client->texts()[0];
  EXPECT_FALSE(info.contains("dataStartTime"));
  EXPECT_EQ(info["capabilities"].back(), "parametersSubscribe");
  operations_->speed = 2;
  hub_.PublishChanges(true);
  EXPECT_TRUE(client->answers().empty());
}

TEST_F(ClientRequestsTest, ACallIsAnsweredWhenItIsDone) {
  const auto client = Join("foxglove.websocket.v1");
  CallStop(*client, 7);
  CallStop(*client, 8);
  ASSERT_EQ(operations_->answers.size(), 2u);
  EXPECT_TRUE(client->answers().empty());
  operations_->answers[1](base::Fail(base::ErrorCode::kUnavailable, "too busy"));
  operations_->answers[0](std::vector<std::byte>(2));
  EXPECT_EQ(client->texts().back(), json({{"op", "serviceCallFailure"},
                                          {"serviceId", 1},
                                          {"callId", 8},
                                          {"message", "too busy"}}));
  ASSERT_EQ(client->answers().size(), 1u);
  EXPECT_EQ(client->answers()[0], std::string("\x03\x01\0\0\0\x07\0\0\0\x03\0\0\0cdr\0\0", 18));
}

TEST_F(ClientRequestsTest, AnAnswerToAFormerClientIsDropped) {
  auto client = Join();
  CallStop(*client, 7);
  hub_.Remove(client.get());
  client.reset();
  operations_->answers[0](std::vector<std::byte>(2));
}

TEST_F(ClientRequestsTest, TheCallsOfAClientAreLimited) {
  const auto client = Join(), other = Join();
  for (char call = 0; call < 20; ++call) CallStop(*client, call);
  EXPECT_EQ(operations_->answers.size(), 8u);
  EXPECT_EQ(client->texts().back()["message"],
            "too many calls of this client are in progress; wait for their responses");
  CallStop(*other, 1);
  EXPECT_EQ(operations_->answers.size(), 9u);
  operations_->answers[0](std::vector<std::byte>());
  CallStop(*client, 21);
  EXPECT_EQ(operations_->answers.size(), 10u);
}

TEST_F(ClientRequestsTest, ACallInAnotherEncodingFails) {
  const auto client = Join();
  EXPECT_TRUE(
      hub_.ReceiveBytes(client.get(), std::string("\x02\x01\0\0\0\x07\0\0\0\x04\0\0\0json", 17)));
  EXPECT_EQ(client->texts().back()["op"], "serviceCallFailure");
  EXPECT_EQ(client->texts().back()["message"], "service requests must use the encoding 'cdr'");
}

TEST_F(ClientRequestsTest, AClientCanReadItsDroppedUpdates) {
  const auto client = Join();
  const json request{
      {"op", "getParameters"}, {"parameterNames", {"/gsv/dropped_updates"}}, {"id", "a"}};
  Send(*client, request);
  EXPECT_EQ(client->texts().back()["parameters"], json::parse(R"([
                {"name":"/gsv/dropped_updates","value":7.0,"type":"float64"}])"));
}

TEST_F(ClientRequestsTest, ParametersAreReadSetAndWatched) {
  const auto client = Join(), watcher = Join();
  Send(*client, {{"op", "getParameters"}, {"parameterNames", json::array()}, {"id", "a"}});
  EXPECT_EQ(client->texts().back(), json::parse(R"({"op":"parameterValues","id":"a","parameters":[
                {"name":"/name","value":"arena"},
                {"name":"/speed","value":1.0,"type":"float64"}]})"));
  Send(*watcher, {{"op", "subscribeParameterUpdates"}, {"parameterNames", {"/speed", "/none"}}});
  Send(*client, json::parse(R"({"op":"setParameters","id":"b","parameters":[
                    {"name":"/name","value":"x"},{"name":"/speed","value":3}]})"));
  const auto texts = client->texts();
  EXPECT_EQ(texts[texts.size() - 2]["message"], "/name is fixed");
  EXPECT_EQ(texts.back()["id"], "b");
  EXPECT_EQ(texts.back()["parameters"][0]["value"], "arena");
  EXPECT_EQ(texts.back()["parameters"][1]["value"], 3.0);
  hub_.PublishChanges();
  hub_.PublishChanges();  // the same values are not sent again
  EXPECT_EQ(watcher->texts().size(), 4u);
  EXPECT_EQ(watcher->texts().back()["parameters"],
            json::parse(R"([{"name":"/speed","value":3.0,"type":"float64"}])"));
  Send(*watcher, {{"op", "unsubscribeParameterUpdates"}, {"parameterNames", json::array()}});
  operations_->speed = 4;
  hub_.PublishChanges();
  EXPECT_EQ(watcher->texts().size(), 4u);
}

TEST_F(ClientRequestsTest, AChangeBackToThePublishedValueIsSentToALaterWatcher) {
  hub_.PublishChanges();  // with speed 1
  operations_->speed = 2;
  const auto watcher = Join();  // the hub sends it the playback state with speed 2
  Send(*watcher, {{"op", "subscribeParameterUpdates"}, {"parameterNames", {"/speed"}}});
  const std::size_t states = watcher->answers().size();
  operations_->speed = 1;
  hub_.PublishChanges();
  EXPECT_EQ(watcher->texts().back()["parameters"],
            json::parse(R"([{"name":"/speed","value":1.0,"type":"float64"}])"));
  EXPECT_EQ(watcher->answers().size(), states + 1);
  hub_.PublishChanges();
  EXPECT_EQ(watcher->answers().size(), states + 1);
}

TEST_F(ClientRequestsTest, ReportsAtMostTenErrorsOfARequest) {
  const auto client = Join();
  const std::size_t before = client->texts().size();
  json parameters = json::array();
  for (int i = 0; i < 1000; ++i) parameters.push_back({{"name", "/name"}, {"value", 1}});
  Send(*client, {{"op", "setParameters"}, {"parameters", parameters}});
  EXPECT_EQ(client->texts().size(), before + 10);
}

TEST_F(ClientRequestsTest, APlaybackIsControlledAndAllClientsGetItsState) {
  const auto client = Join(), other = Join();
  // The message requests to play at speed 2, from the time 3 ns on.
  EXPECT_TRUE(hub_.ReceiveBytes(
      client.get(), std::string("\x03\0\0\0\0\x40\x01\x03\0\0\0\0\0\0\0\x01\0\0\0q", 20)));
  EXPECT_EQ(operations_->speed, 2);
  const std::string state("\x05\0\x05\0\0\0\0\0\0\0\0\0\0\x40", 14);
  EXPECT_EQ(client->answers().back(), state + std::string("\x01\x01\0\0\0q", 6));
  hub_.PublishChanges(true);
  EXPECT_EQ(other->answers().back(), state + std::string("\x01\0\0\0\0", 5));
  const std::size_t before = other->answers().size();
  hub_.PublishChanges();
  EXPECT_EQ(other->answers().size(), before);
}

TEST_F(ClientRequestsTest, TheConnectionGraphListsPublishersSubscribersAndServices) {
  const auto channels = hub_.Advertise(
      {{0, "/a", "cdr", "p/msg/N", "ros2msg", ""}, {0, "/b", "cdr", "p/msg/N", "ros2msg", ""}});
  hub_.SetPublishers(channels[1], {"robot"});
  const auto client = Join(), watcher = Join();
  Send(*watcher, {{"op", "subscribeConnectionGraph"}});
  const json whole = watcher->texts().back();
  EXPECT_EQ(whole["publishedTopics"], json::parse(R"([{"name":"/a","publisherIds":["gsv"]},
                            {"name":"/b","publisherIds":["robot"]}])"));
  EXPECT_EQ(whole["advertisedServices"],
            json::parse(R"([{"name":"/gsv/stop","providerIds":["gsv"]}])"));
  ASSERT_TRUE(hub_.Receive(client.get(), testing::SubscribeText(1, channels[0])));
  hub_.PublishChanges();
  EXPECT_EQ(watcher->texts().back()["subscribedTopics"],
            json::parse(R"([{"name":"/a","subscriberIds":["viewer 1"]}])"));
  hub_.Remove(client.get());
  hub_.Unadvertise(std::vector{channels[1]});
  hub_.PublishChanges();
  EXPECT_EQ(watcher->texts().back()["subscribedTopics"],
            json::parse(R"([{"name":"/a","subscriberIds":[]}])"));
  EXPECT_EQ(watcher->texts().back()["removedTopics"], json({"/b"}));
  const std::size_t told = watcher->texts().size();
  Send(*watcher, {{"op", "unsubscribeConnectionGraph"}});
  hub_.Unadvertise(std::vector{channels[0]});
  hub_.PublishChanges();
  EXPECT_EQ(watcher->texts().size(), told + 1);  // only "unadvertise" was sent, no graph update
}

// Tests commands by name, and the conversion of requests to their services.
class CommandServicesTest : public ::testing::Test {
 protected:
  base::Result<std::function<CommandServices::Response()>> Prepare(std::uint32_t service,
                                                                   std::string request) const {
    return services_.Prepare({service, 1, "cdr", std::move(request)});
  }

  std::int64_t count_ = -1;
  const CommandServices services_{
      {{{.name = "pause"},
        [this](const simulation::Arguments&) {
          count_ = 0;
          return std::string("well");
        }},
       {*simulation::FindCommand("step"),
        [this](const simulation::Arguments& given) -> base::Result<std::string> {
          count_ = given.Get<std::int64_t>("count");
          return base::Fail(base::ErrorCode::kNotRunning, "no");
        }},
       {{.name = "lift_up",
         .parameters = {{.name = "height",
                         .unit = "m",
                         .summary = "how high",
                         .minimum = -2,
                         .maximum = 2,
                         .default_meaning = "to the top"},
                        {.name = "gently", .type = simulation::ParameterType::kFlag},
                        {.name = "of",
                         .type = simulation::ParameterType::kText,
                         .default_value = std::string("all")}}},
        [this](const simulation::Arguments& given) {
          lifted_ = given.values();
          return std::string();
        }}}};
  simulation::Arguments::Values lifted_;
};

TEST_F(CommandServicesTest, ATriggerTakesAnEmptyRequestInEveryEncoding) {
  for (const std::string& nothing :
       {std::string(), std::string("\0\1\0\0", 4), std::string("\0\1\0\0\0", 5)}) {
    count_ = -1;
    EXPECT_EQ((*Prepare(1, nothing))().size(), 4u + 1 + 3 + 4 + 5);  // true, and "well"
    EXPECT_EQ(count_, 0);
  }
  EXPECT_FALSE(Prepare(1, std::string("\0\1\0\0 too much", 13)));
}

TEST_F(CommandServicesTest, AStepTakesACountAndReportsARefusal) {
  const std::string header("\0\1\0\0", 4);
  const CommandServices::Response response =
      (*Prepare(2, header + std::string("\x07\0\0\0\0\0\0\0", 8)))();
  EXPECT_EQ(count_, 7);
  messages::CdrReader reader(response);
  bool success = true;
  std::string message;
  reader.Read(success);
  reader.Read(message);
  EXPECT_TRUE(reader.Finish());
  EXPECT_FALSE(success);
  EXPECT_EQ(message, "no");
  (*Prepare(2, header + std::string(8, '\0')))();
  EXPECT_EQ(count_, 1);
  EXPECT_FALSE(Prepare(2, header + std::string(8, '\x7f')));
  EXPECT_FALSE(Prepare(2, header));
  EXPECT_FALSE(Prepare(2, ""));
}

TEST_F(CommandServicesTest, EachParameterIsAFieldOfTheRequest) {
  const foxglove::Service service = services_.list()[2];
  EXPECT_EQ(service.name, "/gsv/lift_up");
  EXPECT_EQ(service.type, "gsv_msgs/srv/LiftUp");
  EXPECT_EQ(service.request.schema,
            "# how high: a number from -2 to 2 m; NaN: to the top\nfloat64 height\n"
            "# : true or false\nbool gently\n"
            "# : a text; empty: all\nstring of\n");
  const auto request = [](double height, bool gently, const std::string& of) {
    messages::Bytes bytes;
    {
      messages::CdrWriter writer(bytes);
      writer.Write(height);
      writer.Write(gently);
      writer.Write(of);
    }
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  (*Prepare(3, request(-1.5, true, "crates")))();
  EXPECT_EQ(lifted_, (simulation::Arguments::Values{
                         {"height", -1.5}, {"gently", true}, {"of", std::string("crates")}}));
  (*Prepare(3, request(std::nan(""), false, "")))();
  EXPECT_EQ(lifted_,
            (simulation::Arguments::Values{{"gently", false}, {"of", std::string("all")}}));
  EXPECT_EQ(Prepare(3, request(2.5, false, "")).error().Sentence(),
            "lift_up: 'height' must be a number from -2 to 2 m, and it is 2.5");
}

TEST_F(CommandServicesTest, ReportsAnUnknownService) {
  EXPECT_EQ(Prepare(0, "").error().Sentence(), "there is no service 0");
  EXPECT_EQ(Prepare(4, "").error().Sentence(), "there is no service 4");
}

}  // namespace
}  // namespace gsv::gateway
