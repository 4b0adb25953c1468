#include "gsv/orb/errors.h"

#include "gsv/orb/transport/tls_channel.h"
#include "gsv/orb/transport/transports.h"

namespace gsv::orb {
namespace {

using base::ErrorCode;

// Makes the message contain the name `where` only once. Removes `where` from the beginning of the
// reason, or clears `where` if the reason begins with a path below it.
void NameOnce(base::Error& error) {
  if (error.where.empty() || !error.message.starts_with(error.where)) return;
  const std::string rest = error.message.substr(error.where.size());
  if (rest.starts_with(": ")) error.message = rest.substr(2);
  if (rest.starts_with("/")) error.where.clear();
}

// If the exception is an `Exception`, sets `error` to its reason and returns true. All exceptions
// of the module sba have one member, the reason.
template <typename Exception>
bool Matches(const CORBA::UserException& exception, const std::string& where, ErrorCode code,
             base::Error& error) {
  const Exception* found = Exception::_downcast(&exception);
  if (found == nullptr) return false;
  error = {code, std::string(found->reason), where};
  NameOnce(error);
  return true;
}

}  // namespace

std::string WhyNotConnected(const CORBA::SystemException& exception) {
  std::string tls_failure = TakeTlsFailure();
  const bool is_transient = CORBA::TRANSIENT::_downcast(&exception) != nullptr;
  if (is_transient && exception.minor() == omni::TRANSIENT_NoUsableProfile && SpeaksTls()) {
    return "the server does not support TLS, and is not on this machine: start it with a "
           "certificate, or allow this with --insecure-corba (GSV_INSECURE_CORBA=1)";
  }
  const bool is_about_connection =
      is_transient || CORBA::COMM_FAILURE::_downcast(&exception) != nullptr;
  return is_about_connection ? tls_failure : std::string();
}

void ForgetConnectionFailure() { (void)TakeTlsFailure(); }

base::Error ToError(const CORBA::SystemException& exception, const std::string& where) {
  if (const std::string why = WhyNotConnected(exception); !why.empty()) {
    return {ErrorCode::kUnavailable, why, where};
  }
  if (CORBA::TRANSIENT::_downcast(&exception) != nullptr) {
    if (exception.minor() == omni::TRANSIENT_CallTimedout) {
      return {ErrorCode::kTimeout, "did not respond in time", where};
    }
    return {ErrorCode::kUnavailable, "no program accepts connections at this address", where};
  }
  if (CORBA::TIMEOUT::_downcast(&exception) != nullptr) {
    return {ErrorCode::kTimeout, "did not respond in time", where};
  }
  if (CORBA::COMM_FAILURE::_downcast(&exception) != nullptr) {
    return {ErrorCode::kUnavailable, "the connection broke during the call", where};
  }
  if (CORBA::OBJECT_NOT_EXIST::_downcast(&exception) != nullptr) {
    return {ErrorCode::kEnded, "the service no longer exists", where};
  }
  if (CORBA::MARSHAL::_downcast(&exception) != nullptr) {
    return {ErrorCode::kCorrupt, "the message could not be decoded; it may exceed the size limit",
            where};
  }
  return {ErrorCode::kUnavailable, std::string("the call failed (") + exception._name() + ")",
          where};
}

base::Error ToError(const CORBA::UserException& exception, const std::string& where) {
  base::Error error;
  if (Matches<sba::Refused>(exception, where, ErrorCode::kInvalidArgument, error) ||
      Matches<sba::NotRunning>(exception, where, ErrorCode::kNotRunning, error) ||
      Matches<sba::Ended>(exception, where, ErrorCode::kEnded, error) ||
      Matches<sba::Failed>(exception, where, ErrorCode::kUnavailable, error)) {
    return error;
  }
  return {ErrorCode::kUnavailable, std::string("the call raised ") + exception._name(), where};
}

bool MeansGone(const CORBA::SystemException& exception) {
  if (CORBA::OBJECT_NOT_EXIST::_downcast(&exception) != nullptr) return true;
  return CORBA::TRANSIENT::_downcast(&exception) != nullptr &&
         exception.minor() == omni::TRANSIENT_ConnectFailed;
}

namespace {

unsigned BestFit(base::ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidArgument:
    case ErrorCode::kNotFound:
    case ErrorCode::kBadModel:
      return kRefused;
    case ErrorCode::kNotRunning:
      return kNotRunning;
    case ErrorCode::kEnded:
      return kEnded;
    default:
      return kFailed;
  }
}

}  // namespace

void Throw(const base::Error& error, unsigned raises) {
  const std::string reason = error.Sentence();
  for (const unsigned choice : {BestFit(error.code), unsigned{kFailed}, unsigned{kEnded},
                                unsigned{kRefused}, unsigned{kNotRunning}}) {
    if ((choice & raises) == 0) continue;
    switch (choice) {
      case kRefused:
        throw sba::Refused(reason.c_str());
      case kNotRunning:
        throw sba::NotRunning(reason.c_str());
      case kEnded:
        throw sba::Ended(reason.c_str());
      default:
        throw sba::Failed(reason.c_str());
    }
  }
  throw CORBA::INTERNAL();
}

}  // namespace gsv::orb
