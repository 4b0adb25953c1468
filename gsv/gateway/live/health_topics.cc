#include "gsv/gateway/live/health_topics.h"

#include <algorithm>
#include <utility>

#include "gsv/gateway/foxglove/channels.h"
#include "gsv/messages/time.h"
#include "gsv/presentation/health_messages.h"

namespace gsv::gateway {
namespace {

constexpr double kHealthRate = 2;  // maximum rate of messages, Hz of wall-clock time

bool AreSame(const messages::gsv_msgs::Expectations& a, const messages::gsv_msgs::Expectations& b) {
  const auto is_same = [](const auto& x, const auto& y) {
    return x.name == y.name && x.state == y.state && x.has_margin == y.has_margin &&
           x.margin == y.margin && x.margin_at_s == y.margin_at_s;
  };
  return std::equal(a.expectations.begin(), a.expectations.end(), b.expectations.begin(),
                    b.expectations.end(), is_same);
}

}  // namespace

HealthTopics::HealthTopics(std::shared_ptr<Hub> hub)
    : hub_(std::move(hub)),
      health_{.pacing = Pacing(kHealthRate)},
      expectations_{.pacing = Pacing(kHealthRate)} {
  const auto channels = hub_->Advertise(
      {ChannelFor(presentation::topics::kHealth), ChannelFor(presentation::topics::kExpectations)});
  health_.channel = channels[0];
  expectations_.channel = channels[1];
}

void HealthTopics::Publish(simulation::Simulation& simulation, WallTime now) {
  if (IsDue(health_, now)) PublishHealth(simulation, now);
  if (IsDue(expectations_, now)) PublishExpectations(simulation, now);
}

bool HealthTopics::IsDue(const Topic& topic, WallTime now) const {
  return hub_->IsSubscribed(topic.channel) &&
         (topic.pacing.IsDue(now) || hub_->HasNewSubscribers(topic.channel));
}

void HealthTopics::PublishHealth(simulation::Simulation& simulation, WallTime now) {
  auto message = presentation::HealthMessage(tracker_.Update(
      simulation.status(), simulation.specification().stuck_after, health::SensorsOf(simulation)));
  const bool is_news = !health_.latest || presentation::NeedsSending(message, health_sent_);
  const base::SimTime time = messages::ToSimTime(message.stamp);
  Send(health_, is_news, time, Encoded(message), now);
  if (is_news) health_sent_ = std::move(message);
}

void HealthTopics::PublishExpectations(const simulation::Simulation& simulation, WallTime now) {
  const base::SimTime time = simulation.snapshot()->state.time;
  auto message = presentation::ExpectationsMessage(time, simulation.expectations());
  const bool is_news = !expectations_.latest || !AreSame(message, expectations_sent_);
  Send(expectations_, is_news, time, Encoded(message), now);
  if (is_news) expectations_sent_ = std::move(message);
}

void HealthTopics::Send(Topic& topic, bool is_news, base::SimTime time, SharedBytes payload,
                        WallTime now) {
  topic.latest = Hub::Message{base::NanosecondsOf(time), std::move(payload)};
  topic.pacing.Done(now);
  if (is_news) return hub_->Publish(topic.channel, *topic.latest);
  if (hub_->HasNewSubscribers(topic.channel)) hub_->Welcome(topic.channel, {&*topic.latest, 1});
}

}  // namespace gsv::gateway
