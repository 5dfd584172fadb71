// lockstep monitor: the terminal.
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>

#include "cli/describe_table.hpp"
#include "cli/monitor_traces.hpp"

namespace lockstep::cli {
namespace {

constexpr char kEnter[] = "\033[?1049h\033[?25l";  // alternate screen, no cursor
constexpr char kLeave[] = "\033[?25h\033[?1049l";
constexpr std::size_t kUsualHeight = 24;

termios before{};  // of the terminal; one screen at a time

void put(const std::string& text) {
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t taken = write(STDOUT_FILENO, text.data() + written, text.size() - written);
    if (taken <= 0) return;  // a terminal that is gone ends the program by a signal
    written += static_cast<std::size_t>(taken);
  }
}

}  // namespace

Screen::Screen() : keys_(tcgetattr(STDIN_FILENO, &before) == 0) {
  if (keys_) {
    termios raw = before;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | ISIG);  // Ctrl-C is a key
    tcsetattr(STDIN_FILENO, TCSANOW, &raw);
  }
  put(kEnter);
}

Screen::~Screen() {
  put(kLeave);
  if (keys_) tcsetattr(STDIN_FILENO, TCSANOW, &before);
}

std::size_t Screen::width() const {
  return output_width();
}

std::size_t Screen::height() const {
  winsize size{};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 0;
  return known ? std::max<std::size_t>(size.ws_row, 4) : kUsualHeight;
}

void Screen::show(const std::string& title, const std::vector<std::string>& lines) {
  page_ = height() - 2;
  const std::size_t lowest = lines.size() > page_ ? lines.size() - page_ : 0;
  top_ = std::min(top_, lowest);
  const std::size_t last = std::min(top_ + page_, lines.size());
  std::string text = "\033[H\033[7m" + padded(title.substr(0, width()), width()) + "\033[0m\r\n";
  for (std::size_t i = top_; i < top_ + page_; ++i) text += (i < last ? lines[i] : "") + "\033[K\r\n";
  std::string foot = "q ends";
  if (lines.size() > page_)
    foot = fmt::format("lines {} to {} of {}; arrows, PgUp, PgDn, Home, End scroll; ", top_ + 1, last,
                       lines.size()) +
           foot;
  put(text + foot.substr(0, width()) + "\033[K");
}

void Screen::act(const std::string& key) {
  constexpr std::size_t kEnd = 1'000'000'000;  // `show` cuts it to what there is
  if (key == "q" || key == "Q" || key == "\x03" || key == "\x04") end_ = true;
  if (key == "\033[A" || key == "\033OA" || key == "k") top_ -= std::min<std::size_t>(top_, 1);
  if (key == "\033[B" || key == "\033OB" || key == "j") ++top_;
  if (key == "\033[5~") top_ -= std::min(top_, page_);
  if (key == "\033[6~" || key == " ") top_ += page_;
  if (key == "\033[H" || key == "\033OH" || key == "\033[1~") top_ = 0;
  if (key == "\033[F" || key == "\033OF" || key == "\033[4~") top_ = kEnd;
}

bool Screen::take_keys() {
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  while (keys_ && !end_ && poll(&input, 1, 0) == 1) {
    char bytes[64];
    const ssize_t got = read(STDIN_FILENO, bytes, sizeof bytes);
    if (got <= 0) {
      end_ = true;  // the terminal is gone
      break;
    }
    std::string key;
    for (ssize_t i = 0; i < got; ++i) {
      key += bytes[i];
      const bool opening = key == "\033" || key == "\033[" || key == "\033O";
      const bool number = key.size() > 2 && key[0] == '\033' && bytes[i] >= '0' && bytes[i] <= '9';
      if (opening || number) continue;
      act(key);
      key.clear();
    }
  }
  return !end_;
}

}  // namespace lockstep::cli
