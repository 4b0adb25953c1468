#include "gsv/broker/transport/message_check.h"

#include <algorithm>

#include "gsv/broker/transport/type_code_check.h"

namespace gsv::broker {
namespace {

// Requests without an answer that are remembered.
constexpr std::size_t kPending = 1024;

// Of the operations that pass an `any` or a TypeCode, one letter an argument:
//   a any   b boolean   d desired properties   D property definitions   o reference
//   O offers   p property   P properties, policies   s string   S strings   t TypeCode
//   u unsigned long
using Signatures = std::map<std::string_view, std::string_view>;

const Signatures& RequestSignatures() {
  static const Signatures signatures = {
      {"query", "sssPdu"},        {"export", "osP"},    {"modify", "sSP"},
      {"export_proxy", "osPbsP"}, {"add_type", "ssDS"}, {"evalDP", "sta"},
  };
  return signatures;
}

// Of what the broker asks others.
const Signatures& ReplySignatures() {
  static const Signatures signatures = {{"query", "OoS"}, {"next_n", "bO"}, {"evalDP", "a"}};
  return signatures;
}

const Signatures& ExceptionSignatures() {
  static const Signatures signatures = {
      {"IDL:omg.org/CosTrading/Lookup/PolicyTypeMismatch:1.0", "p"},
      {"IDL:omg.org/CosTrading/Lookup/InvalidPolicyValue:1.0", "p"},
      {"IDL:omg.org/CosTradingDynamic/DPEvalFailure:1.0", "sta"},
  };
  return signatures;
}

class ArgumentCheck {
 public:
  explicit ArgumentCheck(CdrReader& in) : in_(in) {}

  bool Matches(std::string_view signature) {
    for (const char kind : signature) Read(kind);
    return in_.ok();
  }

 private:
  void Read(char kind) {
    switch (kind) {
      case 'a':
        return types_.Any(in_);
      case 'b':
        return in_.Skip(1);
      case 'd':
        if (in_.ULong() == 1) Each("s");
        return;
      case 'D':
        return Each("stu");
      case 'o':
        return TypeCodeCheck::Reference(in_);
      case 'O':
        return Each("oP");
      case 'p':
        Read('s');
        return Read('a');
      case 'P':
        return Each("p");
      case 's':
        in_.Octets();
        return;
      case 'S':
        return Each("s");
      case 't':
        return types_.TypeCode(in_);
      default:
        in_.ULong();
    }
  }
  // Of a sequence.
  void Each(std::string_view signature) {
    for (std::uint32_t left = in_.Count(); left > 0 && in_.ok(); --left) Matches(signature);
  }

  CdrReader& in_;
  TypeCodeCheck types_;
};

void SkipServiceContexts(CdrReader& in) {
  for (std::uint32_t left = in.Count(); left > 0 && in.ok(); --left) {
    in.ULong();
    in.Octets();
  }
}

void SkipTarget(CdrReader& in) {
  switch (in.UShort()) {
    case 0:  // an object key
      in.Octets();
      return;
    case 1:  // a profile
      in.ULong();
      in.Octets();
      return;
    default:
      in.ULong();
      TypeCodeCheck::Reference(in);
  }
}

struct RequestHeader {
  std::uint32_t id = 0;
  std::string_view operation;
};

// Leaves `in` at the body.
RequestHeader ReadRequestHeader(CdrReader& in) {
  RequestHeader header;
  if (in.minor() < 2) SkipServiceContexts(in);
  header.id = in.ULong();
  in.Skip(1);
  if (in.minor() >= 1) in.Skip(3);
  if (in.minor() == 2) {
    SkipTarget(in);
    header.operation = in.String();
    SkipServiceContexts(in);
    if (in.remaining() > 0) in.Align(8);
  } else {
    in.Octets();
    header.operation = in.String();
    in.Octets();  // the principal
  }
  return header;
}

struct ReplyHeader {
  std::uint32_t id = 0;
  std::uint32_t status = 0;
};

ReplyHeader ReadReplyHeader(CdrReader& in) {
  if (in.minor() < 2) SkipServiceContexts(in);
  ReplyHeader header;
  header.id = in.ULong();
  header.status = in.ULong();
  if (in.minor() == 2) {
    SkipServiceContexts(in);
    if (in.remaining() > 0) in.Align(8);
  }
  return header;
}

CdrReader BodyOf(std::string_view message, const GiopHeader& header) {
  return CdrReader(message, header.little_endian, header.minor, kGiopHeaderBytes);
}

void CutAt(std::string& message, std::size_t size) {
  message.resize(size);
  CompleteGiopHeader(message);
}

}  // namespace

void CheckRequest(std::string& message) {
  const auto header = ReadGiopHeader(message);
  if (!header || header->type != GiopHeader::kRequest) return;
  CdrReader in = BodyOf(message, *header);
  const RequestHeader request = ReadRequestHeader(in);
  if (!in.ok()) return;  // the ORB refuses it
  const auto signature = RequestSignatures().find(request.operation);
  if (signature == RequestSignatures().end()) return;
  const std::size_t body = in.position();
  if (!ArgumentCheck(in).Matches(signature->second)) CutAt(message, body);
}

bool IsPropertySequence(std::string_view encapsulation) {
  if (encapsulation.empty()) return false;
  CdrReader in(encapsulation, encapsulation.front() != 0, 2, 1);
  return ArgumentCheck(in).Matches("P");
}

void ReplyCheck::Sending(std::string_view bytes, std::size_t sent) {
  if (rest_ == 0) {
    const auto header = bytes.size() < kGiopHeaderBytes ? std::nullopt : ReadGiopHeader(bytes);
    if (!header) return;
    rest_ = kGiopHeaderBytes + header->body_bytes;
    if (header->type == GiopHeader::kRequest) {
      CdrReader in = BodyOf(bytes, *header);
      const RequestHeader request = ReadRequestHeader(in);
      if (operations_.size() >= kPending) operations_.erase(operations_.begin());
      operations_[request.id] = request.operation;
    }
  }
  rest_ -= std::min(rest_, sent);
}

void ReplyCheck::Check(std::string& message) {
  const auto header = ReadGiopHeader(message);
  if (!header || header->type != GiopHeader::kReply) return;
  CdrReader in = BodyOf(message, *header);
  const ReplyHeader reply = ReadReplyHeader(in);
  if (!in.ok()) return;
  const std::size_t body = in.position();
  std::string_view signature;
  if (reply.status == 0) {
    const auto operation = operations_.find(reply.id);
    // Nobody asked for it.
    if (operation == operations_.end()) return CutAt(message, body);
    const auto found = ReplySignatures().find(operation->second);
    if (found != ReplySignatures().end()) signature = found->second;
  } else if (reply.status == 1) {
    const auto found = ExceptionSignatures().find(in.String());
    if (found != ExceptionSignatures().end()) signature = found->second;
  }
  if (!ArgumentCheck(in).Matches(signature)) CutAt(message, body);
  operations_.erase(reply.id);
}

}  // namespace gsv::broker
