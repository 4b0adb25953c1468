// Tests GET /metrics and /healthz.
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/base/sanitizer.h"
#include "gsv/gateway/gateway.h"
#include "gsv/gateway/metrics/exposition.h"
#include "gsv/gateway/metrics/process_usage.h"
#include "gsv/gateway/testing/scripted_simulation.h"
#include "gsv/gateway/testing/simulation_list.h"
#include "gsv/gateway/testing/web_client.h"

namespace gsv::gateway::metrics {
namespace {

using testing::HttpReply;
using testing::Viewer;

struct Family {
  std::string help, type;
  std::map<std::string, double> samples;  // values by the text of their labels: {phase="running"}
};

// Reads the text format 0.0.4 strictly, and independently of the writer. Checks that each family
// has its HELP, its TYPE and its samples in this order and in one place, and that no sample occurs
// twice.
std::map<std::string, Family> ParseStrictly(const std::string& text) {
  static const std::regex kHelp(R"(# HELP ([a-zA-Z_:][a-zA-Z0-9_:]*) (\S.*))");
  static const std::regex kType(R"(# TYPE ([a-zA-Z_:][a-zA-Z0-9_:]*) (counter|gauge))");
  static const std::regex kSample(
      R"re(([a-zA-Z_:][a-zA-Z0-9_:]*)((?:\{[a-zA-Z_][a-zA-Z0-9_]*="(?:[^"\\\n]|\\["\\n])*"(?:,[a-zA-Z_][a-zA-Z0-9_]*="(?:[^"\\\n]|\\["\\n])*")*\})?) ([-+]?[0-9]+(?:\.[0-9]+)?(?:e[-+]?[0-9]+)?|NaN|[+-]Inf))re");
  std::map<std::string, Family> families;
  std::string current, announced;
  EXPECT_TRUE(text.empty() || text.back() == '\n');
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, kHelp)) {
      announced = match[1];
      EXPECT_FALSE(families.contains(announced)) << line;
      families[announced].help = match[2];
      current.clear();
    } else if (std::regex_match(line, match, kType)) {
      EXPECT_EQ(match[1], announced) << line;
      current = match[1];
      families[current].type = match[2];
    } else if (std::regex_match(line, match, kSample)) {
      EXPECT_EQ(match[1], current) << line;
      EXPECT_TRUE(families[match[1]].samples.emplace(match[2], std::stod(match[3])).second) << line;
    } else {
      ADD_FAILURE() << "not in the format: " << line;
    }
  }
  for (const auto& [name, family] : families) {
    EXPECT_EQ(name.ends_with("_total"), family.type == "counter") << name;
  }
  return families;
}

TEST(Exposition, EscapesNewlinesBackslashesAndQuotes) {
  Exposition out;
  out.Begin("a_metric", Exposition::Kind::kGauge, "one\nline \\ and \"quotes\"");
  out.Add(0.25, {{"label", "a \"b\" \\ \n"}});
  out.Add(std::uint64_t{18'446'744'073'709'551'615u});
  EXPECT_EQ(out.text(),
            "# HELP a_metric one\\nline \\\\ and \"quotes\"\n"
            "# TYPE a_metric gauge\n"
            "a_metric{label=\"a \\\"b\\\" \\\\ \\n\"} 0.25\n"
            "a_metric 18446744073709551615\n");
  EXPECT_EQ(ParseStrictly(out.text()).at("a_metric").samples.size(), 2u);
}

TEST(Exposition, WritesNonFiniteNumbers) {
  Exposition out;
  out.Put("a", Exposition::Kind::kGauge, "none", std::nan(""));
  out.Put("b", Exposition::Kind::kGauge, "large", -HUGE_VAL);
  EXPECT_NE(out.text().find("\na NaN\n"), std::string::npos);
  EXPECT_NE(out.text().find("\nb -Inf\n"), std::string::npos);
}

TEST(ProcessUsage, MeasuresThisProcess) {
  const ProcessUsage before = ReadProcessUsage();
  EXPECT_GT(before.resident_bytes, 1u << 20);
  EXPECT_GE(before.threads, 1u);
  EXPECT_GE(before.max_descriptors, before.descriptors);
  EXPECT_GE(before.uptime, 0);
  EXPECT_GT(before.start_time, 1.6e9);
  std::FILE* const file = std::fopen("/dev/null", "r");
  ASSERT_NE(file, nullptr);
  EXPECT_EQ(ReadProcessUsage().descriptors, before.descriptors + 1);
  std::fclose(file);
}

TEST(ProcessUsage, CountsAllocationsOfAnySize) {
  if (base::kReservesAddressSpace) GTEST_SKIP() << "a sanitizer's own malloc does not tell";
  for (const std::size_t size : {std::size_t{1000}, std::size_t{64} << 20}) {
    constexpr std::size_t kTotal = std::size_t{64} << 20;
    const std::uint64_t before = ReadProcessUsage().allocated_bytes;
    std::vector<std::unique_ptr<char[]>> held;
    for (std::size_t sum = 0; sum < kTotal; sum += size) {
      held.push_back(std::make_unique_for_overwrite<char[]>(size));
    }
    const double share = static_cast<double>(ReadProcessUsage().allocated_bytes - before) / kTotal;
    EXPECT_GT(share, 0.99) << size;
    EXPECT_LT(share, 1.1) << size;
    held.clear();
    EXPECT_LT(ReadProcessUsage().allocated_bytes, before + kTotal / 10) << size;
  }
}

class MetricsTest : public ::testing::Test {
 protected:
  void Start(const access::Tokens& tokens = {}) {
    directory_->Add(simulation_);
    GatewayOptions options;
    options.version = "1.2.3";
    options.tokens = tokens;
    options.broker_calls = [] { return BrokerCalls{7, 2}; };
    auto gateway = Gateway::Start(options, directory_);
    ASSERT_TRUE(gateway) << gateway.error().Sentence();
    gateway_ = *std::move(gateway);
  }
  HttpReply Ask(const std::string& target, const std::string& headers = "") const {
    return testing::Fetch(gateway_->port(), "GET", target, headers);
  }
  std::map<std::string, Family> Metrics() const {
    const HttpReply reply = Ask("/metrics");
    EXPECT_EQ(reply.status, 200);
    EXPECT_EQ(reply.headers.at("content-type"), "text/plain; version=0.0.4; charset=utf-8");
    return ParseStrictly(reply.body);
  }
  double Value(const std::string& name, const std::string& labels = "") const {
    const auto families = Metrics();
    return families.at(name).samples.at(labels);
  }

  const std::shared_ptr<testing::SimulationList> directory_ =
      std::make_shared<testing::SimulationList>();
  const std::shared_ptr<testing::ScriptedSimulation> simulation_ =
      std::make_shared<testing::ScriptedSimulation>("arena \"of\" all", 1);
  std::unique_ptr<Gateway> gateway_;
};

TEST_F(MetricsTest, CountSimulationsRobotsAndCalls) {
  Start();
  EXPECT_EQ(Value("gsv_simulations", "{phase=\"created\"}"), 1);
  EXPECT_EQ(Value("gsv_simulations", "{phase=\"running\"}"), 0);
  EXPECT_EQ(Value("gsv_robots"), static_cast<double>(simulation_->status().robots.size()));
  EXPECT_EQ(Value("gsv_broker_calls_total"), 7);
  EXPECT_EQ(Value("gsv_broker_errors_total"), 2);
  EXPECT_EQ(Value("gsv_build_info", "{version=\"1.2.3\"}"), 1);
  ASSERT_TRUE(simulation_->Start());
  const auto families = Metrics();
  EXPECT_EQ(families.at("gsv_simulations").samples.at("{phase=\"running\"}"), 1);
  EXPECT_EQ(families.at("gsv_real_time_factor").samples.size(), 2u);
}

TEST_F(MetricsTest, CountViewersAndSentBytes) {
  Start();
  EXPECT_EQ(Value("gsv_viewers"), 0);
  const double sent = Value("gsv_sent_bytes_total");
  EXPECT_GT(sent, 0);  // the bytes of the responses to earlier requests
  const double refused = Value("gsv_http_answers_total", "{status=\"4xx\"}");
  EXPECT_EQ(Ask("/nothing").status, 404);
  EXPECT_EQ(Value("gsv_http_answers_total", "{status=\"4xx\"}"), refused + 1);
  {
    Viewer viewer(gateway_->port());
    ASSERT_TRUE(viewer.Receive());  // the viewer is connected now
    EXPECT_EQ(Value("gsv_viewers"), 1);
    EXPECT_GE(Value("gsv_connections"), 2);
    viewer.Close();
    while (viewer.Receive()) {
    }
  }
  EXPECT_GT(Value("gsv_sent_bytes_total"), sent);
  // The server's thread notices later that the viewer has left. Each check is a request to this
  // thread, so it makes progress.
  for (int i = 0; i < 1000 && Value("gsv_viewers") > 0; ++i) {
  }
  EXPECT_EQ(Value("gsv_viewers"), 0);
}

TEST_F(MetricsTest, CountViewsThatTheServerDraws) {
  Start();
  EXPECT_EQ(Value("gsv_drawn_views"), 0);
  EXPECT_EQ(Value("gsv_drawn_view_clients"), 0);
  EXPECT_EQ(Value("gsv_drawn_images_total"), 0);
  const HttpReply image = Ask("/view.jpg?size=64x48");
  EXPECT_EQ(Value("gsv_drawn_images_total"), image.status == 200 ? 1 : 0);
}

TEST_F(MetricsTest, HaveNoUserDefinedLabels) {
  Start();
  static const std::set<std::string> kAllowed{"phase", "of", "status", "version"};
  for (const auto& [name, family] : Metrics()) {
    EXPECT_LE(family.samples.size(), 7u) << name;
    for (const auto& [labels, value] : family.samples) {
      if (labels.empty()) continue;
      EXPECT_TRUE(kAllowed.contains(labels.substr(1, labels.find('=') - 1))) << name << labels;
      EXPECT_EQ(labels.find("arena"), std::string::npos);
    }
  }
}

TEST_F(MetricsTest, NeedThePermissionToWatch) {
  const std::string control = "control-token-0123456789", watch = "watching-token-0123456789";
  Start({control, watch});
  EXPECT_EQ(Ask("/metrics").status, 401);
  EXPECT_EQ(Ask("/metrics", "Authorization: Bearer wrong-token-0123456789\r\n").status, 403);
  EXPECT_EQ(Ask("/metrics", "Authorization: Bearer " + watch + "\r\n").status, 200);
  EXPECT_EQ(Ask("/metrics", "Authorization: Bearer " + control + "\r\n").status, 200);
  // /healthz needs no token.
  EXPECT_EQ(Ask("/healthz").body, R"({"ok":true})");
  EXPECT_EQ(testing::Fetch(gateway_->port(), "POST", "/metrics",
                           "Authorization: Bearer " + control + "\r\n")
                .status,
            405);
}

}  // namespace
}  // namespace gsv::gateway::metrics
