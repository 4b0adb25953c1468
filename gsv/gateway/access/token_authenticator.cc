#include "gsv/gateway/access/token_authenticator.h"

#include <algorithm>

namespace gsv::gateway::access {
namespace {

constexpr std::size_t kMinTokenLength = 16, kMaxTokenLength = 256;

bool IsTokenCharacter(char c) {
  const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return is_letter || (c >= '0' && c <= '9') ||
         std::string_view("-._~+/=").find(c) != std::string_view::npos;
}

}  // namespace

base::Status CheckToken(std::string_view token) {
  const bool is_good = token.size() >= kMinTokenLength && token.size() <= kMaxTokenLength &&
                       std::all_of(token.begin(), token.end(), IsTokenCharacter);
  if (is_good) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "a token must have 16 to 256 characters: letters, digits or -._~+/=. `openssl "
                    "rand -hex 16` makes one");
}

bool EqualsSecret(std::string_view shown, std::string_view secret) {
  volatile unsigned char difference = shown.size() == secret.size() ? 0 : 1;
  for (std::size_t i = 0; i < secret.size(); ++i) {
    const char there = i < shown.size() ? shown[i] : '\0';
    difference = difference | static_cast<unsigned char>(there ^ secret[i]);
  }
  return difference == 0;
}

std::string_view BearerToken(std::string_view authorization) {
  static constexpr std::string_view kScheme = "Bearer ";
  return authorization.starts_with(kScheme) ? authorization.substr(kScheme.size())
                                            : std::string_view();
}

void TokenAuthenticator::Authenticate(const Credentials& credentials, Answer answer) {
  answer({PermissionOf(credentials.token), !credentials.token.empty()});
}

Permission TokenAuthenticator::PermissionOf(std::string_view token) const {
  const bool controls = EqualsSecret(token, tokens_.control);
  const bool watches = EqualsSecret(token, tokens_.watch);
  if (tokens_.empty()) return is_exposed_ ? Permission::kNone : Permission::kControl;
  if (!tokens_.control.empty() && controls) return Permission::kControl;
  if (!tokens_.watch.empty() && watches) return Permission::kWatch;
  const bool is_free = token.empty() && !is_exposed_ && tokens_.watch.empty();
  return is_free ? Permission::kWatch : Permission::kNone;
}

std::string TokenAuthenticator::Refusal(const Principal& principal, Permission needed) const {
  const bool needs_control = needed == Permission::kControl;
  if (needs_control && tokens_.control.empty()) {
    return "this server allows no control: it was started without --control-token";
  }
  if (principal.showed_credentials && principal.permission == Permission::kWatch) {
    return "this token does not allow control; use the token given with --control-token";
  }
  const std::string wanted = needs_control
                                 ? "the token given with --control-token"
                                 : "the token given with --control-token or --watch-token";
  return (!principal.showed_credentials ? "this request requires a token: "
                                        : "this token is wrong: use ") +
         wanted;
}

}  // namespace gsv::gateway::access
