#include "tests/studio/browser.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <thread>

namespace lockstep::test {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kPatience{60};

std::vector<std::string> command_line(const std::string& profile) {
  std::vector<std::string> words = {
      "chromium", "--headless", "--remote-debugging-pipe", "--user-data-dir=" + profile,
      "--window-size=1280,720", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run", "--mute-audio",
      "--disable-background-networking", "--disable-component-update", "--disable-sync",
      "--disable-default-apps", "--disable-extensions", "--hide-scrollbars", "--force-color-profile=srgb",
      // Nothing is asked of the internet.
      "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1", "about:blank"};
  if (geteuid() == 0) words.emplace_back("--no-sandbox");  // without which it ends at once as root
  return words;
}

/// Number of a key that has more to do than to write a letter; 0: any other.
int number_of(const std::string& key) {
  static const std::map<std::string, int> kNumbers = {
      {"Backspace", 8}, {"Tab", 9},        {"Enter", 13},   {"Escape", 27},     {"End", 35},
      {"Home", 36},     {"ArrowLeft", 37}, {"ArrowUp", 38}, {"ArrowRight", 39}, {"ArrowDown", 40}};
  const auto found = kNumbers.find(key);
  return found == kNumbers.end() ? 0 : found->second;
}

/// JavaScript for a text.
std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump();
}

}  // namespace

Browser::Browser() {
  start();
  const Json targets = call("Target.getTargets")["targetInfos"];
  std::string target;
  for (const Json& one : targets)
    if (one["type"] == "page") target = one["targetId"];
  if (target.empty()) target = call("Target.createTarget", {{"url", "about:blank"}})["targetId"];
  session_ = call("Target.attachToTarget", {{"targetId", target}, {"flatten", true}})["sessionId"];
  for (const char* domain : {"Page", "Runtime", "Log", "Network"}) call(std::string(domain) + ".enable");
  call("Emulation.setDeviceMetricsOverride",
       {{"width", 1280}, {"height", 720}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

Browser::~Browser() {
  kill();
  if (out_ >= 0) close(out_);
  if (in_ >= 0) close(in_);
}

void Browser::freeze() const {
  if (::kill(-child_, SIGSTOP) != 0) throw std::runtime_error("chromium cannot be frozen");
}

void Browser::thaw() const {
  if (::kill(-child_, SIGCONT) != 0) throw std::runtime_error("chromium cannot be thawed");
}

void Browser::kill() {
  if (child_ <= 0) return;
  ::kill(-child_, SIGKILL);
  // Its other processes end a moment later, and write to its profile until then. They come to this one as
  // their own parents end: whoever takes up orphans of the system may let them lie for seconds.
  while (waitpid(-child_, nullptr, 0) > 0 || errno == EINTR) continue;
  child_ = -1;
}

void Browser::start() {
  int to[2];
  int from[2];
  if (pipe2(to, O_CLOEXEC) != 0 || pipe2(from, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  const std::vector<std::string> words = command_line(directory_.file("profile"));
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  if (prctl(PR_SET_CHILD_SUBREAPER, 1) != 0) throw std::runtime_error("no orphans can be taken up");
  child_ = fork();
  if (child_ == 0) {
    setpgid(0, 0);
    // It reads from 3 and writes to 4. Copies above keep the one from being written over by the other.
    const int read_end = fcntl(to[0], F_DUPFD, 10);
    const int write_end = fcntl(from[1], F_DUPFD, 10);
    dup2(read_end, 3);
    dup2(write_end, 4);
    const int nothing = ::open("/dev/null", O_RDWR);
    dup2(nothing, 0);
    dup2(nothing, 1);
    dup2(nothing, 2);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  setpgid(child_, child_);
  close(to[0]);
  close(from[1]);
  out_ = to[1];
  in_ = from[0];
}

void Browser::send(const std::string& text) const {
  std::string_view rest(text.c_str(), text.size() + 1);  // with the zero that ends it
  while (!rest.empty()) {
    const ssize_t sent = write(out_, rest.data(), rest.size());
    if (sent <= 0) throw std::runtime_error("chromium does not listen; is it installed?");
    rest.remove_prefix(static_cast<std::size_t>(sent));
  }
}

Browser::Json Browser::receive() {
  const auto until = Clock::now() + kPatience;
  std::size_t end = 0;
  while ((end = waiting_.find('\0')) == std::string::npos) {
    pollfd input{in_, POLLIN, 0};
    if (Clock::now() > until) throw std::runtime_error("chromium does not answer");
    if (poll(&input, 1, 1000) <= 0) continue;
    char bytes[1 << 16];
    const ssize_t got = read(in_, bytes, sizeof bytes);
    if (got <= 0) throw std::runtime_error("chromium has ended; is it installed?");
    waiting_.append(bytes, static_cast<std::size_t>(got));
  }
  const Json message = Json::parse(waiting_.substr(0, end));
  waiting_.erase(0, end + 1);
  return message;
}

void Browser::note(const Json& event) {
  const std::string method = event.value("method", "");
  if (method == "Network.requestWillBeSent") requests_.push_back(event["params"]["request"]["url"]);
  if (method == "Network.webSocketCreated") requests_.push_back(event["params"]["url"]);
  if (method == "Runtime.exceptionThrown") complaints_.push_back(event["params"].dump());
  if (method == "Log.entryAdded" && event["params"]["entry"]["level"] == "error")
    complaints_.push_back(event["params"]["entry"].dump());
  if (method == "Runtime.consoleAPICalled" && event["params"]["type"] == "error")
    complaints_.push_back(event["params"]["args"].dump());
}

Browser::Json Browser::call(const std::string& method, const Json& parameters) {
  Json message = {{"id", ++number_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) message["sessionId"] = session_;
  send(message.dump());
  for (;;) {
    const Json answer = receive();
    if (!answer.contains("id")) {
      note(answer);
    } else if (answer["id"] == number_) {
      if (answer.contains("error")) throw std::runtime_error(method + ": " + answer["error"].dump());
      return answer["result"];
    }
  }
}

void Browser::open(const std::string& url) {
  const Json answer = call("Page.navigate", {{"url", url}});
  if (answer.contains("errorText"))
    throw std::runtime_error(url + ": " + answer["errorText"].get<std::string>());
}

Browser::Json Browser::evaluate(const std::string& expression) {
  const Json answer =
      call("Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
  if (answer.contains("exceptionDetails"))
    throw std::runtime_error(expression + ": " + answer["exceptionDetails"].dump());
  return answer["result"].value("value", Json());
}

bool Browser::wait_for(const std::string& expression) {
  const auto until = Clock::now() + kPatience;
  while (Clock::now() < until) {
    // What is looked for may not be there yet.
    if (evaluate("(() => { try { return !!(" + expression + "); } catch { return false; } })()") == true)
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

std::string Browser::text(const std::string& selector) {
  const Json text = evaluate("document.querySelector(" + quoted(selector) + ")?.textContent");
  return text.is_string() ? text.get<std::string>() : "";
}

Browser::Json Browser::middle_of(const std::string& selector) {
  return evaluate("(() => { const e = document.querySelector(" + quoted(selector) +
                  "); e.scrollIntoView({block: 'nearest'}); const r = e.getBoundingClientRect(); "
                  "return {x: r.x + r.width / 2, y: r.y + r.height / 2}; })()");
}

void Browser::click(const std::string& selector) {
  const Json middle = middle_of(selector);
  drag(middle["x"], middle["y"], middle["x"], middle["y"]);
}

void Browser::choose(const std::string& selector, const std::string& value) {
  const std::string element = "document.querySelector(" + quoted(selector) + ")";
  // What is chosen from has to be there: a picture fills its choices when it is drawn.
  if (!wait_for("(" + element + ".options === undefined || [..." + element +
                ".options].some((one) => one.value === " + quoted(value) + "))"))
    throw std::runtime_error(selector + " has no '" + value + "' to choose");
  evaluate("(() => { const e = " + element + "; e.value = " + quoted(value) +
           "; e.dispatchEvent(new Event('change', {bubbles: true})); })()");
}

void Browser::choose_file(const std::string& selector, const std::string& file) {
  const Json root = call("DOM.getDocument")["root"]["nodeId"];
  const Json node = call("DOM.querySelector", {{"nodeId", root}, {"selector", selector}})["nodeId"];
  call("DOM.setFileInputFiles", {{"files", {file}}, {"nodeId", node}});
}

void Browser::move_pointer(double x, double y, bool is_down) {
  call("Input.dispatchMouseEvent", {{"type", "mouseMoved"},
                                    {"x", x},
                                    {"y", y},
                                    {"button", is_down ? "left" : "none"},
                                    {"buttons", is_down ? 1 : 0}});
}

void Browser::press_pointer(double x, double y) {
  move_pointer(x, y, false);
  call("Input.dispatchMouseEvent",
       {{"type", "mousePressed"}, {"x", x}, {"y", y}, {"button", "left"}, {"buttons", 1}, {"clickCount", 1}});
}

void Browser::release_pointer(double x, double y) {
  call(
      "Input.dispatchMouseEvent",
      {{"type", "mouseReleased"}, {"x", x}, {"y", y}, {"button", "left"}, {"buttons", 0}, {"clickCount", 1}});
}

void Browser::drag(double from_x, double from_y, double to_x, double to_y) {
  press_pointer(from_x, from_y);
  for (int step = 1; step <= 4 && (from_x != to_x || from_y != to_y); ++step)
    move_pointer(from_x + (to_x - from_x) * step / 4, from_y + (to_y - from_y) * step / 4, true);
  release_pointer(to_x, to_y);
}

void Browser::turn_wheel(double x, double y, double by) {
  call("Input.dispatchMouseEvent",
       {{"type", "mouseWheel"}, {"x", x}, {"y", y}, {"deltaX", 0}, {"deltaY", by}});
}

void Browser::press(const std::string& key, bool shift) {
  Json event = {{"type", "keyDown"}, {"key", key}, {"modifiers", shift ? 8 : 0}};
  if (const int number = number_of(key); number != 0) event["windowsVirtualKeyCode"] = number;
  if (key.size() == 1) event["text"] = key;
  if (key == "Enter") event["text"] = "\r";
  call("Input.dispatchKeyEvent", event);
  event["type"] = "keyUp";
  event.erase("text");
  call("Input.dispatchKeyEvent", event);
}

void Browser::type(const std::string& text) {
  call("Input.insertText", {{"text", text}});
}

void Browser::prefer_dark(bool dark) {
  call("Emulation.setEmulatedMedia",
       {{"features", {{{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}}}}});
}

std::string Browser::picture() {
  return call("Page.captureScreenshot", {{"format", "png"}})["data"];
}

}  // namespace lockstep::test
