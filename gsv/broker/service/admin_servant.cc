#include "gsv/broker/service/admin_servant.h"

#include <algorithm>
#include <utility>

#include "gsv/broker/service/policy_values.h"
#include "gsv/broker/service/raise.h"
#include "gsv/broker/trader/iterator_keys.h"

namespace gsv::broker {
namespace {

constexpr CORBA::ULong kMaxStemLength = 256;

CosTrading::Admin::OctetSeq* ToCorba(const std::string& octets) {
  CosTrading::Admin::OctetSeq_var result = new CosTrading::Admin::OctetSeq;
  result->length(static_cast<CORBA::ULong>(octets.size()));
  std::copy(octets.begin(), octets.end(), result->get_buffer());
  return result._retn();
}

template <typename Iterator>
CosTrading::OfferIdSeq* ToCorba(Iterator first, Iterator last) {
  CosTrading::OfferIdSeq_var ids = new CosTrading::OfferIdSeq;
  ids->length(static_cast<CORBA::ULong>(last - first));
  for (CORBA::ULong i = 0; first != last; ++first, ++i) ids[i] = first->c_str();
  return ids._retn();
}

std::size_t EncodedSize(const std::string& id, const NoContext&) { return id.size() + 8; }

}  // namespace

AdminServant::AdminServant(TradingObjects& objects)
    : ComponentsServant(objects), SupportServant(objects), ImportServant(objects.trader) {}

template <typename T>
T AdminServant::Exchange(T TraderAttributes::*attribute, T value) {
  ValueOrRaise(objects_.trader.ChangeAttributes(
      [&](TraderAttributes& attributes) { std::swap(attributes.*attribute, value); }));
  return value;
}

CosTrading::FollowOption AdminServant::max_link_follow_policy() {
  return ToCorba(objects_.trader.attributes().max_link_follow_policy);
}

CosTrading::Admin::OctetSeq* AdminServant::request_id_stem() {
  return ToCorba(objects_.trader.attributes().request_id_stem);
}

CosTrading::Admin::OctetSeq* AdminServant::set_request_id_stem(
    const CosTrading::Admin::OctetSeq& stem) {
  if (stem.length() > kMaxStemLength) throw CORBA::IMP_LIMIT(0, CORBA::COMPLETED_NO);
  const std::string octets(reinterpret_cast<const char*>(stem.get_buffer()), stem.length());
  return ToCorba(Exchange(&TraderAttributes::request_id_stem, octets));
}

CORBA::ULong AdminServant::set_def_search_card(CORBA::ULong value) {
  return Exchange(&TraderAttributes::def_search_card, std::uint32_t{value});
}

CORBA::ULong AdminServant::set_max_search_card(CORBA::ULong value) {
  return Exchange(&TraderAttributes::max_search_card, std::uint32_t{value});
}

CORBA::ULong AdminServant::set_def_match_card(CORBA::ULong value) {
  return Exchange(&TraderAttributes::def_match_card, std::uint32_t{value});
}

CORBA::ULong AdminServant::set_max_match_card(CORBA::ULong value) {
  return Exchange(&TraderAttributes::max_match_card, std::uint32_t{value});
}

CORBA::ULong AdminServant::set_def_return_card(CORBA::ULong value) {
  return Exchange(&TraderAttributes::def_return_card, std::uint32_t{value});
}

CORBA::ULong AdminServant::set_max_return_card(CORBA::ULong value) {
  return Exchange(&TraderAttributes::max_return_card, std::uint32_t{value});
}

CORBA::ULong AdminServant::set_max_list(CORBA::ULong value) {
  return Exchange(&TraderAttributes::max_list, std::uint32_t{value});
}

CORBA::ULong AdminServant::set_def_hop_count(CORBA::ULong value) {
  return Exchange(&TraderAttributes::def_hop_count, std::uint32_t{value});
}

CORBA::ULong AdminServant::set_max_hop_count(CORBA::ULong value) {
  return Exchange(&TraderAttributes::max_hop_count, std::uint32_t{value});
}

CosTrading::FollowOption AdminServant::set_def_follow_policy(CosTrading::FollowOption policy) {
  return ToCorba(Exchange(&TraderAttributes::def_follow_policy, FromCorba(policy)));
}

CosTrading::FollowOption AdminServant::set_max_follow_policy(CosTrading::FollowOption policy) {
  return ToCorba(Exchange(&TraderAttributes::max_follow_policy, FromCorba(policy)));
}

CosTrading::FollowOption AdminServant::set_max_link_follow_policy(CosTrading::FollowOption policy) {
  return ToCorba(Exchange(&TraderAttributes::max_link_follow_policy, FromCorba(policy)));
}

CORBA::Boolean AdminServant::set_supports_modifiable_properties(CORBA::Boolean value) {
  return Exchange(&TraderAttributes::supports_modifiable_properties, bool{value});
}

CORBA::Boolean AdminServant::set_supports_dynamic_properties(CORBA::Boolean value) {
  return Exchange(&TraderAttributes::supports_dynamic_properties, bool{value});
}

CORBA::Boolean AdminServant::set_supports_proxy_offers(CORBA::Boolean value) {
  return Exchange(&TraderAttributes::supports_proxy_offers, bool{value});
}

CORBA::Object_ptr AdminServant::set_type_repos(CORBA::Object_ptr repository) {
  if (!objects_.types->_is_equivalent(repository)) {
    throw CORBA::NO_IMPLEMENT(0, CORBA::COMPLETED_NO);
  }
  return CORBA::Object::_duplicate(objects_.types);
}

void AdminServant::list_offers(CORBA::ULong how_many, CosTrading::OfferIdSeq_out ids,
                               CosTrading::OfferIdIterator_out id_itr) {
  HandOut(objects_.trader.OfferIds(), how_many, ids, id_itr);
}

void AdminServant::list_proxies(CORBA::ULong how_many, CosTrading::OfferIdSeq_out ids,
                                CosTrading::OfferIdIterator_out id_itr) {
  HandOut(objects_.trader.ProxyIds(), how_many, ids, id_itr);
}

void AdminServant::HandOut(std::vector<std::string> all, CORBA::ULong how_many,
                           CosTrading::OfferIdSeq_out ids, CosTrading::OfferIdIterator_out id_itr) {
  const std::size_t count = std::min(how_many, objects_.trader.attributes().max_list);
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(CountFitting(
                                     all, 0, count, kReplyBytes,
                                     [](const std::string& id) { return EncodedSize(id, {}); }));
  CosTrading::OfferIdSeq_var first_ids = ToCorba(all.begin(), end);
  CosTrading::OfferIdIterator_var rest;
  if (end != all.end()) {
    all.erase(all.begin(), end);
    const std::uint64_t key = objects_.id_cursors.Open(std::move(all), {});
    const CORBA::Object_var iterator =
        IteratorReference(objects_.id_iterators, key, CosTrading::OfferIdIterator::_PD_repoId);
    rest = CosTrading::OfferIdIterator::_unchecked_narrow(iterator);
  }
  ids = first_ids._retn();
  id_itr = rest._retn();
}

CORBA::ULong OfferIdIteratorServant::max_left() {
  const auto left = objects_.id_cursors.Left(CurrentIterator(objects_.orb));
  if (!left) throw CORBA::OBJECT_NOT_EXIST(0, CORBA::COMPLETED_NO);
  return static_cast<CORBA::ULong>(*left);
}

CORBA::Boolean OfferIdIteratorServant::next_n(CORBA::ULong n, CosTrading::OfferIdSeq_out ids) {
  const std::size_t count = std::min(n, objects_.trader.attributes().max_list);
  const auto batch =
      objects_.id_cursors.Take(CurrentIterator(objects_.orb), count, kReplyBytes, EncodedSize);
  if (!batch) throw CORBA::OBJECT_NOT_EXIST(0, CORBA::COMPLETED_NO);
  ids = ToCorba(batch->entries.begin(), batch->entries.end());
  return batch->more;
}

void OfferIdIteratorServant::destroy() {
  if (!objects_.id_cursors.Close(CurrentIterator(objects_.orb))) {
    throw CORBA::OBJECT_NOT_EXIST(0, CORBA::COMPLETED_NO);
  }
}

}  // namespace gsv::broker
