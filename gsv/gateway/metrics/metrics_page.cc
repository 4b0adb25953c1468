#include "gsv/gateway/metrics/metrics_page.h"

#include <algorithm>
#include <array>
#include <vector>

#include "gsv/base/log.h"
#include "gsv/gateway/metrics/exposition.h"
#include "gsv/gateway/metrics/process_usage.h"
#include "gsv/simulation/pace/totals.h"

namespace gsv::gateway::metrics {
namespace {

using simulation::Phase;
constexpr auto kCounter = Exposition::Kind::kCounter;
constexpr auto kGauge = Exposition::Kind::kGauge;

constexpr std::array kPhases{Phase::kCreated, Phase::kStarting, Phase::kRunning, Phase::kPaused,
                             Phase::kStopped, Phase::kFinished, Phase::kFailed};

void PutSimulations(SimulationDirectory& directory, Exposition& out) {
  std::array<std::uint64_t, kPhases.size()> by_phase{};
  std::uint64_t robots = 0;
  std::vector<double> factors;
  for (const auto& each : directory.List()) {
    const simulation::SimulationStatus status = each->status();
    ++by_phase[static_cast<std::size_t>(status.phase)];
    robots += status.CountRobots();
    if (status.phase == Phase::kRunning) factors.push_back(status.real_time_factor);
  }
  out.Begin("gsv_simulations", kGauge, "Number of simulations, by phase.");
  for (const Phase phase : kPhases) {
    out.Add(by_phase[static_cast<std::size_t>(phase)], {{"phase", ToString(phase)}});
  }
  out.Put("gsv_robots", kGauge, "Number of robots and avatars of all simulations.", robots);
  out.Begin("gsv_real_time_factor", kGauge,
            "Real-time factor of the slowest and the fastest running simulation.");
  if (!factors.empty()) {
    out.Add(*std::min_element(factors.begin(), factors.end()), {{"of", "slowest"}});
    out.Add(*std::max_element(factors.begin(), factors.end()), {{"of", "fastest"}});
  }
  const simulation::Totals& totals = simulation::ProcessTotals();
  out.Put("gsv_steps_total", kCounter, "Steps taken by all simulations.", totals.steps.load());
  out.Put("gsv_late_steps_total", kCounter, "Real-time steps that started at least one step late.",
          totals.late_steps.load());
}

void PutRecordings(RecordingSwitch& recordings, Exposition& out) {
  const RecordingSwitch::Totals totals = recordings.totals();
  out.Put("gsv_recordings", kGauge, "Number of recordings in progress.", totals.under_way);
  out.Put("gsv_recorded_bytes_total", kCounter, "Bytes written to recordings.", totals.bytes);
  out.Put("gsv_recorded_messages_total", kCounter, "Messages recorded.", totals.messages);
  out.Put("gsv_recording_dropped_messages_total", kCounter,
          "Messages not recorded because the disk was too slow.", totals.dropped);
}

void PutTraffic(const Traffic& traffic, Exposition& out) {
  out.Put("gsv_connections", kGauge, "Connections to the viewer's port.",
          traffic.connections.load());
  out.Put("gsv_connections_turned_away_total", kCounter,
          "Connections refused because there were too many.", traffic.turned_away.load());
  out.Put("gsv_viewers", kGauge, "Viewers that have a simulation open.", traffic.viewers.load());
  out.Put("gsv_sent_bytes_total", kCounter, "Bytes of responses and updates sent to viewers.",
          traffic.sent_bytes.load());
  out.Put("gsv_dropped_updates_total", kCounter, "Updates not sent because a viewer was too slow.",
          traffic.dropped_updates.load());
  out.Begin("gsv_http_answers_total", kCounter, "HTTP responses, by status class.");
  for (const char* status : {"1xx", "2xx", "3xx", "4xx", "5xx"}) {
    out.Add(traffic.answers[status[0] - '0'].load(), {{"status", status}});
  }
}

void PutDrawnViews(const DrawnViews& drawn, Exposition& out) {
  out.Put("gsv_drawn_views", kGauge, "Number of different views that this server draws now.",
          drawn.views);
  out.Put("gsv_drawn_view_clients", kGauge, "Requests and streams that receive these views now.",
          drawn.clients);
  out.Put("gsv_drawn_images_total", kCounter, "Images drawn for viewers.", drawn.images);
}

void PutBroker(const BrokerCalls& calls, Exposition& out) {
  out.Put("gsv_broker_calls_total", kCounter, "Calls to the broker.", calls.made);
  out.Put("gsv_broker_errors_total", kCounter, "Calls to the broker that failed.", calls.failed);
}

// Adds the metrics of this process. Most names are those of Prometheus' own client libraries.
void PutProcess(const MetricsSources& sources, Exposition& out) {
  const ProcessUsage usage = ReadProcessUsage();
  out.Begin("gsv_build_info", kGauge, "Always 1; the label is the version.");
  out.Add(std::uint64_t{1}, {{"version", sources.version}});
  out.Put("gsv_uptime_seconds", kGauge, "Time since this process started.", usage.uptime);
  out.Put("process_start_time_seconds", kGauge, "Start time of this process, since 1970.",
          usage.start_time);
  out.Put("process_cpu_seconds_total", kCounter, "Processor time used.", usage.processor_seconds);
  out.Put("process_resident_memory_bytes", kGauge, "Resident memory.", usage.resident_bytes);
  out.Put("gsv_allocated_memory_bytes", kGauge, "Memory allocated with malloc.",
          usage.allocated_bytes);
  out.Put("process_threads", kGauge, "Threads of this process.", usage.threads);
  out.Put("process_open_fds", kGauge, "Open file descriptors.", usage.descriptors);
  out.Put("process_max_fds", kGauge, "Maximum number of open file descriptors.",
          usage.max_descriptors);
}

void PutLog(Exposition& out) {
  const base::LogCounts counts = base::ProcessLogCounts();
  out.Put("gsv_log_lines_total", kCounter, "Lines written to the log.", counts.written);
  out.Put("gsv_log_suppressed_lines_total", kCounter,
          "Lines not written to the log because there were too many.", counts.suppressed);
}

}  // namespace

Response MetricsPage(const MetricsSources& sources, const Traffic& traffic) {
  Exposition out;
  if (sources.directory != nullptr) PutSimulations(*sources.directory, out);
  if (sources.recordings != nullptr) PutRecordings(*sources.recordings, out);
  PutTraffic(traffic, out);
  if (sources.drawn_views) {
    if (const auto drawn = sources.drawn_views()) PutDrawnViews(*drawn, out);
  }
  if (sources.broker_calls) PutBroker(sources.broker_calls(), out);
  PutLog(out);
  PutProcess(sources, out);
  Response response;
  response.content_type = std::string(kContentType);
  response.body = SharedBytes(std::string(out.text()));
  return response;
}

std::vector<Route> Monitor::Routes() const {
  using enum Permission;
  using enum Pool;
  return {
      {"GET", "/healthz", kNone, false, kReaders,
       [](const Request&) { return JsonResponse(200, R"({"ok":true})"); },
       "Check that the server responds"},
      {"GET", "/metrics", kWatch, false, kReaders,
       [this](const Request&) { return MetricsPage(sources_, *traffic_); },
       "Get the metrics of the server and its simulations, for monitoring"},
  };
}

}  // namespace gsv::gateway::metrics
