#include "hmi_bridge/studio/guard.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>

namespace lockstep {
namespace {

constexpr std::size_t kShortestToken = 32;
constexpr std::size_t kLongestToken = 256;

char lower(char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool is_same_name(std::string_view a, std::string_view b) noexcept {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

/// "HOST" and "PORT" of "HOST:PORT"; no port: 80.
struct Authority {
  std::string_view host;
  std::uint32_t port = 80;
  bool is_valid = false;
};

Authority authority_of(std::string_view text) noexcept {
  Authority authority;
  const std::size_t bracket = text.rfind(']');
  std::size_t colon = text.rfind(':');
  if (colon != text.npos && bracket != text.npos && colon < bracket) colon = text.npos;
  authority.host = text.substr(0, colon);
  authority.is_valid = !authority.host.empty();
  if (colon == text.npos) return authority;
  const std::string_view port = text.substr(colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), authority.port);
  if (error != std::errc{} || end != port.data() + port.size()) authority.is_valid = false;
  return authority;
}

/// Whether a page of this host asks.
bool is_origin(std::string_view origin, std::string_view host) noexcept {
  for (const std::string_view scheme : {"http://", "https://"})
    if (origin.starts_with(scheme)) return is_same_name(origin.substr(scheme.size()), host);
  return false;
}

bool is_json(std::string_view content_type) noexcept {
  return is_same_name(content_type.substr(0, content_type.find(';')), "application/json");
}

bool has_known_type(const StudioCredentials& request) noexcept {
  return is_json(request.content_type) || (request.takes_files && is_studio_upload(request.content_type));
}

bool has_token(std::string_view query) noexcept {
  return query.starts_with("token=") || query.find("&token=") != query.npos;
}

class File {
 public:
  explicit File(const char* path) : number_(open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK)) {}
  ~File() {
    if (number_ >= 0) close(number_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int number() const noexcept { return number_; }

 private:
  int number_;
};

}  // namespace

bool StudioGuard::is_host(const StudioCredentials& request) const noexcept {
  const Authority host = authority_of(request.host);
  if (!host.is_valid) return false;
  for (const std::string& name : names_)
    if (is_same_name(host.host, name)) return true;
  if (host.port != request.local_port) return false;
  return is_same_name(host.host, "localhost") || is_same_name(host.host, request.local_address);
}

bool StudioGuard::is_token(std::string_view token) const noexcept {
  if (token_.empty()) return true;
  unsigned difference = token.size() == token_.size() ? 0 : 1;
  for (std::size_t i = 0; i < token_.size(); ++i)
    difference |= static_cast<unsigned char>(token_[i]) ^
                  static_cast<unsigned char>(i < token.size() ? token[i] : '\0');
  return difference == 0;
}

StudioRefusal StudioGuard::judge(const StudioCredentials& request) const noexcept {
  if (!is_host(request))
    return {403, "not_allowed",
            "the header Host has to be the address of the studio, localhost with its port, or a name given "
            "by --studio-host"};
  if (has_token(request.query))
    return {400, "bad_request", "a token stands in the header Authorization, never in an address"};
  if (request.changes && !is_origin(request.origin, request.host))
    return {403, "not_allowed", "the header Origin has to be there and to be this studio"};
  if (request.changes && !request.is_socket && !has_known_type(request))
    return {403, "not_allowed", "the header Content-Type has to be application/json"};
  if (request.is_public || request.is_socket || token_.empty()) return {};
  constexpr std::string_view kBearer = "Bearer ";
  const bool given = request.authorization.starts_with(kBearer);
  if (!given || !is_token(request.authorization.substr(kBearer.size())))
    return {401, "not_allowed", "the header Authorization has to be 'Bearer ' and the token"};
  return {};
}

bool is_studio_upload(std::string_view content_type) noexcept {
  const std::string_view type = content_type.substr(0, content_type.find(';'));
  return is_same_name(type, "text/csv") || is_same_name(type, "application/octet-stream");
}

std::string read_studio_token(const std::string& path, std::string& problem) {
  const File file(path.c_str());
  struct stat status {};
  if (file.number() < 0 || fstat(file.number(), &status) != 0) {
    problem = path + ": " + std::strerror(errno);
    return "";
  }
  if (!S_ISREG(status.st_mode) || (status.st_mode & 077) != 0) {
    problem = path + ": has to be a file that nobody but its owner may read (chmod 600)";
    return "";
  }
  std::array<char, kLongestToken + 2> text{};
  const ssize_t size = read(file.number(), text.data(), text.size());
  std::string token(text.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  if (token.ends_with('\n')) token.pop_back();
  const bool is_plain = std::all_of(token.begin(), token.end(), [](char c) { return c > ' ' && c <= '~'; });
  if (!is_plain || token.size() < kShortestToken || token.size() > kLongestToken) {
    problem =
        path +
        ": a token is one line of 32 to 256 characters without blanks, such as `openssl rand -hex 32` gives";
    return "";
  }
  return token;
}

}  // namespace lockstep
