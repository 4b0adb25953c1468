#include "gsv/orb/giop/message_check.h"

#include <algorithm>

#include "gsv/base/check.h"
#include "gsv/orb/giop/giop_header.h"
#include "gsv/orb/giop/type_code_check.h"

namespace gsv::orb {
namespace {

// The number of unanswered requests that are remembered.
constexpr std::size_t kPending = 1024;

// Returns the types of an operation; empty for an unknown name.
std::string_view TypesOf(std::span<const Signature> signatures, std::string_view name) {
  const auto found = std::ranges::find(signatures, name, &Signature::name);
  return found != signatures.end() ? found->types : std::string_view();
}

// Removes the part of `types` before the first `end` outside of brackets, and `end` itself. Returns
// the part.
std::string_view TakeUntil(std::string_view& types, char end) {
  std::size_t size = 0;
  for (int depth = 0; depth > 0 || types.at(size) != end; ++size) {
    if (types.at(size) == '[' || types.at(size) == '<') ++depth;
    if (types.at(size) == ']' || types.at(size) == '>') --depth;
  }
  const std::string_view taken = types.substr(0, size);
  types.remove_prefix(size + 1);
  return taken;
}

// Checks values against the types in a signature.
class ValueCheck {
 public:
  explicit ValueCheck(CdrReader& in) : in_(in) {}

  bool Has(std::string_view types) {
    while (!types.empty() && in_.ok()) Read(types);
    return in_.ok();
  }

 private:
  // Reads a value of the first type in `types`, and removes that type from `types`.
  void Read(std::string_view& types) {
    const char kind = types.front();
    types.remove_prefix(1);
    switch (kind) {
      case 'a':
        return type_codes_.Any(in_);
      case 't':
        return type_codes_.TypeCode(in_);
      case 's':
        in_.Octets();  // skips the string; the ORB checks its terminating null
        return;
      case 'o':
        return SkipReference(in_);
      case '[':
        return ReadSequence(TakeUntil(types, ']'));
      case '<':
        return ReadUnion(TakeUntil(types, '>'));
      default:
        ReadNumber(kind);
    }
  }
  void ReadSequence(std::string_view element) {
    for (std::uint32_t left = in_.Count(); left > 0 && in_.ok(); --left) Has(element);
  }
  void ReadUnion(std::string_view members) {
    const std::string value = std::to_string(ReadNumber(TakeUntil(members, ';').front()));
    while (!members.empty()) {
      const std::string_view label = TakeUntil(members, ':');
      const std::string_view types = TakeUntil(members, ';');
      if (label != "*" && label != value) continue;
      Has(types);
      return;
    }
  }
  std::uint64_t ReadNumber(char size) {
    switch (size) {
      case '1':
        return in_.Octet();
      case '2':
        return in_.UShort();
      case '4':
        return in_.ULong();
      case '8':
        return in_.ULongLong();
      default:
        GSV_CHECK(!"a signature has a type that is not known");
        return 0;
    }
  }

  CdrReader& in_;
  TypeCodeCheck type_codes_;
};

void CutAt(std::string& message, std::size_t size) {
  message.resize(size);
  CompleteGiopHeader(message);
}

}  // namespace

void CheckRequest(const Signatures& signatures, std::string& message) {
  const auto header = ReadGiopHeader(message);
  if (!header || header->type != GiopHeader::kRequest) return;
  CdrReader in = ReaderBehind(*header, message);
  const RequestHeader request = ReadRequestHeader(in);
  if (!in.ok()) return;  // the header is invalid; the ORB refuses the message
  const std::string_view types = TypesOf(signatures.requests, request.operation);
  const std::size_t body = in.position();
  if (!ValueCheck(in).Has(types)) CutAt(message, body);
}

bool HasTypes(std::string_view encapsulation, std::string_view types) {
  CdrReader in = CdrReader::OfEncapsulation(encapsulation);
  return ValueCheck(in).Has(types);
}

void ReplyCheck::Sending(std::string_view bytes) {
  if (rest_ != 0 || bytes.size() < kGiopHeaderBytes) return;
  const auto header = ReadGiopHeader(bytes);
  if (!header) return;
  rest_ = kGiopHeaderBytes + header->body_bytes;
  if (header->type != GiopHeader::kRequest) return;
  CdrReader in = ReaderBehind(*header, bytes);
  const RequestHeader request = ReadRequestHeader(in);
  if (operations_.size() >= kPending) operations_.erase(operations_.begin());
  operations_[request.id] = request.operation;
}

void ReplyCheck::Sent(std::size_t count) { rest_ -= std::min(rest_, count); }

void ReplyCheck::Check(std::string& message) {
  const auto header = ReadGiopHeader(message);
  if (!header || header->type != GiopHeader::kReply) return;
  CdrReader in = ReaderBehind(*header, message);
  const ReplyHeader reply = ReadReplyHeader(in);
  if (!in.ok()) return;
  const std::size_t body = in.position();
  std::string_view types;
  if (reply.status == ReplyHeader::kNoException) {
    const auto operation = operations_.find(reply.id);
    if (operation == operations_.end()) return CutAt(message, body);
    types = TypesOf(signatures_.replies, operation->second);
  } else if (reply.status == ReplyHeader::kUserException) {
    types = TypesOf(signatures_.exceptions, in.String());
  }
  if (!ValueCheck(in).Has(types)) CutAt(message, body);
  operations_.erase(reply.id);
}

}  // namespace gsv::orb
