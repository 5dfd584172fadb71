/// The pages of a run, connected by their WebSockets: what each has subscribed, and what they are told.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/studio/handler.hpp"
#include "hmi_bridge/studio/stream.hpp"
#include "projects/loader/project.hpp"
#include "projects/studio/feed.hpp"

namespace lockstep {

struct StudioMessage;

/// Thread: the server's.
class StudioPages {
 public:
  static constexpr std::size_t kSubscribed = 512;  ///< paths of a subscription

  StudioPages(const Project& project, const StudioUnits& units, StudioFeed& feed)
      : project_(project), units_(units), feed_(feed) {}

  void open(StudioClient& client) { pages_[&client]; }
  /// @return false: there was no such page
  bool close(StudioClient& client) noexcept { return pages_.erase(&client) != 0; }

  /// From here on the page is told things. @throws studio_api::BadRequest if the token is wrong
  void admit(StudioClient& client, const StudioMessage& message);
  bool is_known(StudioClient& client) const { return pages_.at(&client).is_known; }
  void subscribe(StudioClient& client, const StudioMessage& message);
  void unsubscribe(StudioClient& client, const StudioMessage& message);
  void acknowledge(StudioClient& client, const StudioMessage& message);

  /// A text for all that have said hello.
  void tell(const std::string& text) const;
  /// The same, a text for each of them by `text_for(StudioClient&)`.
  template <class TextFor>
  void tell_each(TextFor text_for) const {
    for (const auto& [client, page] : pages_)
      if (page.is_known) client->send_text(text_for(*client));
  }
  /// New rows, for all that can take them.
  void send_rows();
  std::size_t size() const noexcept { return pages_.size(); }

  /// Calls `add` with each signal that is wanted.
  template <class Add>
  void wanted(Add add) const {
    for (const auto& [client, page] : pages_)
      for (const auto& [id, subscribed] : page.subscriptions)
        for (const NamedSignal& signal : subscribed) add(signal);
  }

 private:
  struct Page {
    StudioStream stream;
    std::map<std::uint32_t, std::vector<NamedSignal>> subscriptions;
    bool is_known = false;  // it has said hello
  };

  std::uint64_t every_of(const StudioMessage& message) const;
  void check_sum(std::size_t more, const Page& page, std::uint32_t id) const;

  const Project& project_;
  const StudioUnits& units_;
  StudioFeed& feed_;
  std::map<StudioClient*, Page> pages_;
};

}  // namespace lockstep
