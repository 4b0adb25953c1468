#include "gsv/broker/client/client_errors.h"

#include <fmt/format.h>
#include <COS/CosTrading.hh>
#include <COS/CosTradingRepos.hh>

#include "gsv/broker/client/corbaloc.h"
#include "gsv/broker/language/expression.h"

namespace gsv::broker {
namespace {

using base::Error;
using base::ErrorCode;
using Register = CosTrading::Register;
using Repository = CosTradingRepos::ServiceTypeRepository;

constexpr ErrorCode kWrong = ErrorCode::kInvalidArgument;
constexpr ErrorCode kMissing = ErrorCode::kNotFound;

// Returns the reason why the broker rejected a constraint or preference. The broker's exception
// contains only the text, without the reason. So this client parses the text again, and `parsed` is
// the result. If parsing succeeded, an operand has the wrong type.
std::string WhyRefused(const base::Status& parsed) {
  return parsed ? "its operands do not have the types that the service type declares"
                : parsed.error().Sentence();
}

std::string WhyConstraint(const char* text) {
  const auto parsed = ParseConstraint(text, {});
  return WhyRefused(parsed ? base::Status() : base::Fail(parsed.error()));
}

std::string WhyPreference(const char* text) {
  const auto parsed = ParsePreference(text, {});
  return WhyRefused(parsed ? base::Status() : base::Fail(parsed.error()));
}

Error OfQuery(const std::string& where) {
  try {
    throw;
  } catch (const CosTrading::IllegalServiceType& e) {
    return {kWrong, fmt::format("\"{}\" is not a valid name of a service type", e.type.in()),
            where};
  } catch (const CosTrading::UnknownServiceType& e) {
    return {kMissing, fmt::format("the broker knows no service type {}", e.type.in()), where};
  } catch (const CosTrading::IllegalConstraint& e) {
    return {kWrong,
            fmt::format("the constraint \"{}\" is refused: {}", e.constr.in(),
                        WhyConstraint(e.constr.in())),
            where};
  } catch (const CosTrading::Lookup::IllegalPreference& e) {
    return {kWrong,
            fmt::format("the preference \"{}\" is refused: {}", e.pref.in(),
                        WhyPreference(e.pref.in())),
            where};
  }
}

Error OfOffer(const std::string& where) {
  try {
    throw;
  } catch (const Register::InvalidObjectRef&) {
    return {kWrong, "the offered service is nil, or does not respond to the broker", where};
  } catch (const Register::InterfaceTypeMismatch& e) {
    return {kWrong,
            fmt::format(
                "the offered service does not have the interface that the service type {} requires",
                e.type.in()),
            where};
  } catch (const CosTrading::IllegalPropertyName& e) {
    return {kWrong, fmt::format("\"{}\" is not a valid name of a property", e.name.in()), where};
  } catch (const CosTrading::DuplicatePropertyName& e) {
    return {kWrong, fmt::format("the property {} is given twice", e.name.in()), where};
  } catch (const CosTrading::PropertyTypeMismatch& e) {
    return {kWrong,
            fmt::format("the property {} has another type than {} declares", e.prop.name.in(),
                        e.type.in()),
            where};
  } catch (const CosTrading::MissingMandatoryProperty& e) {
    return {kWrong, fmt::format("{} requires the property {}", e.type.in(), e.name.in()), where};
  } catch (const CosTrading::ReadonlyDynamicProperty& e) {
    return {kWrong,
            fmt::format("the property {} of {} is read-only and cannot be dynamic", e.name.in(),
                        e.type.in()),
            where};
  } catch (const Register::ReadonlyProperty& e) {
    return {kWrong,
            fmt::format("the property {} of {} is read-only and cannot be changed", e.name.in(),
                        e.type.in()),
            where};
  } catch (const Register::MandatoryProperty& e) {
    return {kWrong,
            fmt::format("the property {} of {} is mandatory and cannot be removed", e.name.in(),
                        e.type.in()),
            where};
  } catch (const CosTrading::IllegalOfferId& e) {
    return {kWrong, fmt::format("\"{}\" is not a valid id of an offer", e.id.in()), where};
  } catch (const CosTrading::UnknownOfferId& e) {
    return {kMissing, fmt::format("the broker has no offer {}", e.id.in()), where};
  } catch (const CORBA::UserException&) {
    return OfQuery(where);
  }
}

Error OfLink(const std::string& where) {
  try {
    throw;
  } catch (const CosTrading::Link::IllegalLinkName& e) {
    return {kWrong, fmt::format("\"{}\" is not a valid name of a link", e.name.in()), where};
  } catch (const CosTrading::Link::DuplicateLinkName& e) {
    return {kWrong,
            fmt::format("a link named {} exists already; remove it first, or choose another name",
                        e.name.in()),
            where};
  } catch (const CosTrading::Link::UnknownLinkName& e) {
    return {
        kMissing,
        fmt::format("the broker has no link named {}; `gsv links` lists its links", e.name.in()),
        where};
  } catch (const CosTrading::Link::DefaultFollowTooPermissive&) {
    return {kWrong,
            "the default follow policy of the link is more permissive than its limiting policy",
            where};
  } catch (const CosTrading::Link::LimitingFollowTooPermissive&) {
    return {kWrong,
            "the limiting policy of the link is more permissive than the broker's "
            "max_link_follow_policy",
            where};
  } catch (const CosTrading::InvalidLookupRef&) {
    return {kWrong, "the target of the link is not a broker, or does not respond", where};
  } catch (const CORBA::UserException&) {
    return OfOffer(where);
  }
}

Error OfType(const std::string& where) {
  try {
    throw;
  } catch (const Repository::ServiceTypeExists& e) {
    return {kWrong,
            fmt::format("the service type {} exists already with another definition", e.name.in()),
            where};
  } catch (const Repository::InterfaceTypeMismatch& e) {
    return {
        kWrong,
        fmt::format("the interface of {} does not derive from the interface of its super type {}",
                    e.derived_service.in(), e.base_service.in()),
        where};
  } catch (const Repository::ValueTypeRedefinition& e) {
    return {kWrong,
            fmt::format("{} and {} define the property {} differently", e.type_1.in(),
                        e.type_2.in(), e.definition_1.name.in()),
            where};
  } catch (const Repository::DuplicateServiceTypeName& e) {
    return {kWrong, fmt::format("the super type {} is named twice", e.name.in()), where};
  } catch (const Repository::HasSubTypes& e) {
    return {kWrong,
            fmt::format("the service type {} has a sub type, {}; remove that first",
                        e.the_type.in(), e.sub_type.in()),
            where};
  } catch (const CORBA::UserException&) {
    return OfLink(where);
  }
}

Error OfSystem(const std::string& where) {
  try {
    throw;
  } catch (const CORBA::TIMEOUT&) {
    return {ErrorCode::kTimeout, "the broker did not respond in time", where};
  } catch (const CORBA::TRANSIENT& e) {
    if (e.minor() == omni::TRANSIENT_CallTimedout) {
      return {ErrorCode::kTimeout, "the broker did not respond in time", where};
    }
    const std::string why = orb::WhyNotConnected(e);
    return {ErrorCode::kUnavailable,
            why.empty() ? "no broker responds at this address; start one with `gsv broker`" : why,
            where};
  } catch (const CORBA::COMM_FAILURE& e) {
    const std::string why = orb::WhyNotConnected(e);
    if (!why.empty()) return {ErrorCode::kUnavailable, why, where};
    return {ErrorCode::kUnavailable,
            TakesTls(where) ? "the connection to the broker was lost"
                            : "the connection to the broker was lost. If the broker requires TLS, "
                              "use the address corbaloc:ssliop:1.2@HOST:PORT/TradingService",
            where};
  } catch (const CORBA::OBJECT_NOT_EXIST&) {
    return {ErrorCode::kUnavailable, "the object at this address is not a broker", where};
  } catch (const CORBA::IMP_LIMIT&) {
    return {kWrong, "the request exceeds a limit of the broker; docs/broker.md lists the limits",
            where};
  } catch (const CORBA::NO_MEMORY&) {
    return {ErrorCode::kUnavailable,
            "the broker is out of memory; withdraw offers that are not needed", where};
  } catch (const CORBA::SystemException& e) {
    const char* minor = e.NP_minorString();
    return {ErrorCode::kUnavailable,
            fmt::format("the call to the broker failed: {} {}", e._name(),
                        minor != nullptr ? minor : ""),
            where};
  }
}

}  // namespace

CallCounts& ProcessCallCounts() {
  static CallCounts counts;
  return counts;
}

base::Error ErrorOfCurrentException(const std::string& where) {
  ++ProcessCallCounts().failed;
  try {
    try {
      throw;
    } catch (const CORBA::SystemException&) {
      return OfSystem(where);
    } catch (const CORBA::UserException&) {
      return OfType(where);
    }
  } catch (const CORBA::Exception& e) {
    return {ErrorCode::kUnavailable, fmt::format("the broker raised {}", e._name()), where};
  }
}

}  // namespace gsv::broker
