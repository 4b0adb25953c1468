// The services of a ROS 2 node, for clients of rmw_fastrtps and of rmw_cyclonedds.
//
// A client of rmw_fastrtps recognises its reply by the related sample identity (RTPS 2.3, 8.7.5;
// inline QoS). A client of rmw_cyclonedds recognises it by 16 bytes after the encapsulation header;
// the reply repeats these bytes of the request. A request comes from rmw_cyclonedds if the GUID of
// its writer has the vendor of Cyclone DDS. With DDS Security, GUIDs have no vendor; then a request
// comes from rmw_cyclonedds if it has no related identity.
//
// Requests are untrusted input. A request that cannot be decoded gets no reply. Each service logs
// the first such request.
//
// Threads  Offer…(), Advertise() and the destructor from one thread; other functions from any.
//          Handlers run on the threads of the host: one thread for each lane, but kQuick and kLists
//          share a thread. So slow requests do not delay quick ones.
// Bounded  at most 10,000 requests wait for each thread; further requests are dropped, and the
//          first of each service is logged.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gsv/messages/cdr.h"
#include "gsv/ros2/dds/participant.h"
#include "gsv/ros2/services/service_worker.h"

namespace gsv::ros2 {

// Whether this request begins with the 16 bytes of rmw_cyclonedds.
bool HasCycloneHeader(const dds::Request& request);

// Receives the requests of all services of one node, and sends the replies.
class ServiceHost {
 public:
  // Groups of requests. Slow groups have their own threads.
  enum class Lane {
    kQuick,     // requests that are answered at once
    kLists,     // requests that are answered at once with replies that may be large
    kSlow,      // requests that read files or wait for the simulation
    kStepping,  // requests that wait for steps of the simulation
  };
  // One offered service: its handler, and the writer of its replies.
  class Service;
  // Sends the reply to one request, at most once. The object may be kept, and may be used on
  // another thread.
  class Replier {
   public:
    // Sends an encoded message, and returns at once. If the client is not yet discovered, the reply
    // is sent as soon as it is, but at the latest after ten seconds. If 1000 replies wait for
    // discovery already, the reply is dropped.
    void Send(messages::Bytes response) const;
    // Encodes the response, and sends it as Send() does.
    template <typename Response>
    void SendMessage(const Response& response) const {
      messages::Bytes bytes;
      messages::Encode(response, bytes);
      Send(std::move(bytes));
    }

   private:
    friend class ServiceHost;
    std::weak_ptr<Service> service_;
    dds::Request request_;
    std::vector<std::byte> header_;  // header of a reply to rmw_cyclonedds; empty for other clients
  };
  using Handler = std::function<void(std::span<const std::byte> request, const Replier& reply)>;

  // `participant` must outlive the host. If `has_hashes` is true, endpoints contain the hashes of
  // their types.
  ServiceHost(dds::Participant& participant, bool has_hashes);
  // Waits until no handler is running.
  ~ServiceHost();

  // Offers a service, such as "/gsv/get_entities" of the type
  // "simulation_interfaces/srv/GetEntities".
  void OfferBytes(const std::string& service, const std::string& type, Lane lane, Handler handler);

  // `answer` is called with a Request and a Replier.
  template <typename Request, typename Answer>
  void OfferLater(const std::string& service, const std::string& type, Lane lane, Answer answer) {
    OfferBytes(service, type, lane,
               [answer = std::move(answer), service](std::span<const std::byte> bytes,
                                                     const Replier& reply) {
                 const auto request = messages::Decode<Request>(bytes);
                 request ? answer(*request, reply) : Refuse(service, request.error());
               });
  }
  // `answer` is called with a Request, and returns the response.
  template <typename Request, typename Answer>
  void Offer(const std::string& service, const std::string& type, Lane lane, Answer answer) {
    OfferLater<Request>(service, type, lane,
                        [answer = std::move(answer)](const Request& request, const Replier& reply) {
                          reply.SendMessage(answer(request));
                        });
  }

  // Creates a writer for a topic of an action. The host owns the writer. If the participant
  // refuses, returns null and logs the refusal.
  dds::Writer* Advertise(const std::string& topic, const std::string& type, const dds::Qos& qos);

  // Runs a job on the threads of a lane. Returns false if too many jobs wait.
  bool Submit(Lane lane, std::function<void()> job);

  // The readers of all services, for the node graph.
  const std::vector<dds::Guid>& readers() const { return readers_; }
  const std::vector<dds::Guid>& writers() const { return writers_; }

  // Whether the host is being destroyed. Handlers that wait must then return early.
  bool is_stopping() const { return is_stopping_; }

 private:
  // Keeps replies to clients that are not yet discovered, and sends them after discovery.
  class Outbox;
  // Logs the first request of each service that is dropped, for example because it cannot be decoded
  // or because too many requests wait.
  static void Refuse(const std::string& service, const base::Error& error);
  // Passes a request to the thread of the lane. Drops it if too many wait.
  void Enqueue(const std::shared_ptr<Service>& service, Lane lane,
               std::span<const std::byte> sample, const dds::Request& request);

  dds::Participant& participant_;
  const bool has_hashes_;  // whether endpoints contain the hashes of their types
  std::shared_ptr<Outbox> outbox_;
  std::vector<std::shared_ptr<Service>> services_;
  std::vector<std::unique_ptr<dds::Reader>> request_readers_;
  std::vector<dds::Guid> readers_, writers_;
  std::vector<std::unique_ptr<dds::Writer>> topics_;  // the writers of Advertise()
  std::atomic<bool> is_stopping_{false};
  // The threads of the lanes. Requests of the lane kLists run on quick_.
  ServiceWorker quick_, slow_, stepping_;
};

}  // namespace gsv::ros2
