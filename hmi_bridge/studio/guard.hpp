/// Who may ask the studio: what a request has to say of itself, before anybody looks at what it wants.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

/// What a request says of itself.
struct StudioCredentials {
  std::string_view host;           ///< header Host
  std::string_view origin;         ///< header Origin; empty: there is none
  std::string_view content_type;   ///< header Content-Type
  std::string_view authorization;  ///< header Authorization
  std::string_view query;          ///< of the target, behind the question mark
  std::string_view local_address;  ///< to which the client has connected, an IPv6 address in brackets
  std::uint16_t local_port = 0;
  bool changes = false;      ///< not GET or HEAD, or a WebSocket
  bool takes_files = false;  ///< the body may be a file, too
  bool is_public = false;    ///< the page itself, which knows nothing of the machine
  bool is_socket = false;    ///< a WebSocket, which gives its token in the first message
};

/// Why a request is not heard. Texts are fixed: nothing of the request is in them.
struct StudioRefusal {
  unsigned status = 0;  ///< of HTTP; 0: it is heard
  std::string_view code;
  std::string_view text;
};

/// Rules against pages of others, names that point here by a trick, and those without the token. Any thread.
class StudioGuard {
 public:
  /// @param names by which the server may be called besides its address and localhost, on any port, as a
  ///   proxy in front of it is  @param token empty: none is needed
  explicit StudioGuard(std::vector<std::string> names = {}, std::string token = "")
      : names_(std::move(names)), token_(std::move(token)) {}

  StudioRefusal judge(const StudioCredentials& request) const noexcept;
  /// Whether a token is the right one; the time that this takes says nothing of where it differs.
  bool is_token(std::string_view token) const noexcept;
  bool needs_token() const noexcept { return !token_.empty(); }

 private:
  bool is_host(const StudioCredentials& request) const noexcept;

  std::vector<std::string> names_;
  std::string token_;
};

/// Whether the body of a request is a file, by its Content-Type: one that no form of a page sends.
bool is_studio_upload(std::string_view content_type) noexcept;

/// Reads a token from a file that nobody but its owner may read: one line of 32 to 256 characters from `!` to
/// `~`, which hold 128 bits where they are hexadecimal digits by chance.
/// @return empty: it cannot be used, `problem` says why and what is allowed
std::string read_studio_token(const std::string& path, std::string& problem);

}  // namespace lockstep
