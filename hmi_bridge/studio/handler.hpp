/// What stands behind the studio's server: it knows bytes and routes, this knows the machine.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lockstep {

/// A request that may be answered.
struct StudioRequest {
  std::string_view method;                                 ///< GET, POST
  std::string path;                                        ///< decoded, without the query
  std::vector<std::pair<std::string, std::string>> query;  ///< decoded
  std::string_view body;
  std::string_view peer;           ///< address of the client
  std::string_view if_match;       ///< ETag of what is changed, as the client knows it; empty: not told
  std::string_view if_none_match;  ///< `*`: it is made anew; empty: not told
  std::string body_file;  ///< file of the body, which belongs to the handler then; empty: it is in `body`

  /// Value of a key; `otherwise`: it is not there.
  std::string_view value(std::string_view key, std::string_view otherwise = "") const noexcept {
    for (const auto& [name, text] : query)
      if (name == key) return text;
    return otherwise;
  }
};

struct StudioAnswer {
  unsigned status = 200;
  std::string type = "application/json";
  std::string body;
  std::string etag;  ///< empty: none
  std::string cache = "no-store";
  std::string
      file_name;  ///< under which a browser saves it, of letters, digits, `-`, `_` and `.`; empty: none
};

/// A page that is connected by its WebSocket. Thread: the server's.
class StudioClient {
 public:
  virtual ~StudioClient() = default;
  virtual void send_text(std::string text) = 0;
  virtual void send_bytes(std::vector<std::uint8_t> bytes) = 0;
  /// Whether what was sent is on its path, so that it makes sense to send more that can wait.
  virtual bool is_idle() const noexcept = 0;
  /// Whether the page may be heard with this token; remembered once it may.
  virtual bool authorise(std::string_view token) noexcept = 0;
  virtual bool is_authorised() const noexcept = 0;
  /// Address and port of the client.
  virtual std::string_view peer() const noexcept = 0;
};

/// All is called on the server's thread; what is thrown is counted, and ends the connection that it concerns.
class StudioHandler {
 public:
  using Done = std::function<void(StudioAnswer)>;

  virtual ~StudioHandler() = default;
  /// Calls `done` once, now or later on the server's thread. `request` lasts as long as the call.
  virtual void answer(const StudioRequest& request, Done done) = 0;
  virtual void opened(StudioClient& client) = 0;
  virtual void text(StudioClient& client, std::string_view message) = 0;
  virtual void closed(StudioClient& client) noexcept = 0;
  /// Whether files are taken that are sent.
  virtual bool takes_uploads() const noexcept { return false; }
  /// Each 16 ms.
  virtual void look() = 0;
  /// Nothing will be asked any more, and no answer is sent: lets go of each `done`.
  virtual void ended() noexcept = 0;
};

}  // namespace lockstep
