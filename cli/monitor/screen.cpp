#include "cli/monitor/screen.hpp"

#define NCURSES_WIDECHAR 1
#include <langinfo.h>
#include <ncurses.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace lockstep::cli {
namespace {

constexpr int kEscapeDelay = 25;  // [ms] within which the rest of a function key comes

attr_t attributes_of(Look look) {
  switch (look) {
    case Look::title:
    case Look::keys:
      return A_REVERSE;
    case Look::panel:
      return A_REVERSE | A_BOLD;
    case Look::heading:
    case Look::alarm:
    case Look::chosen:
      return A_BOLD;
    case Look::plain:
      return A_NORMAL;
  }
  return A_NORMAL;
}

KeyKind kind_of(int code) {
  switch (code) {
    case KEY_UP:
      return KeyKind::up;
    case KEY_DOWN:
      return KeyKind::down;
    case KEY_LEFT:
      return KeyKind::left;
    case KEY_RIGHT:
      return KeyKind::right;
    case KEY_PPAGE:
      return KeyKind::page_up;
    case KEY_NPAGE:
      return KeyKind::page_down;
    case KEY_HOME:
    case KEY_FIND:
      return KeyKind::first;
    case KEY_END:
    case KEY_SELECT:
      return KeyKind::last;
    case KEY_ENTER:
      return KeyKind::enter;
    case KEY_BACKSPACE:
      return KeyKind::erase;
    default:
      return KeyKind::other;
  }
}

/// Keys that come as a character.
Key key_of(wint_t character) {
  constexpr wint_t kInterrupt = 3, kEnd = 4, kBackspace = 8, kEscape = 27, kDelete = 127;
  switch (character) {
    case kInterrupt:
    case kEnd:
      return {KeyKind::interrupt, ""};
    case '\r':
    case '\n':
      return {KeyKind::enter, ""};
    case '\t':
      return {KeyKind::tab, ""};
    case kEscape:
      return {KeyKind::escape, ""};
    case kBackspace:
    case kDelete:
      return {KeyKind::erase, ""};
    default:
      break;
  }
  char bytes[16];  // MB_CUR_MAX of any locale of glibc
  if (character < 0x20 || MB_CUR_MAX > sizeof bytes) return {};
  const int length = std::wctomb(bytes, static_cast<wchar_t>(character));
  return length > 0 ? Key{KeyKind::text, std::string(bytes, static_cast<std::size_t>(length))} : Key{};
}

}  // namespace

struct Screen::State {
  SCREEN* screen = nullptr;
};

Screen::Screen() : state_(std::make_unique<State>()) {
  std::setlocale(LC_CTYPE, "");
  if (std::string_view(nl_langinfo(CODESET)) == "UTF-8") characters_ = Characters::blocks;
  const char* const terminal = std::getenv("TERM");
  state_->screen = newterm(nullptr, stdout, stdin);
  if (state_->screen == nullptr)
    throw std::runtime_error("the terminal '" + std::string(terminal == nullptr ? "" : terminal) +
                             "' is unknown; allowed in TERM: what terminfo has, such as xterm or vt100");
  set_escdelay(kEscapeDelay);
  raw();  // Ctrl-C is a key, so that the end is the same for all
  noecho();
  nonl();
  curs_set(0);
  keypad(stdscr, TRUE);
  nodelay(stdscr, TRUE);
}

Screen::~Screen() {
  curs_set(1);
  endwin();
  delscreen(state_->screen);
}

ViewSize Screen::size() const {
  return {static_cast<std::size_t>(std::max(COLS, 1)), static_cast<std::size_t>(std::max(LINES, 1))};
}

void Screen::show(const std::vector<ViewLine>& lines) {
  erase();
  for (std::size_t i = 0; i < lines.size() && i < size().height; ++i) {
    const ViewLine& line = lines[i];
    attrset(static_cast<int>(attributes_of(line.look)));
    mvaddstr(static_cast<int>(i), 0, line.text.c_str());
    const bool bar = line.look == Look::title || line.look == Look::keys || line.look == Look::panel;
    while (bar && getcurx(stdscr) > 0 && getcury(stdscr) == static_cast<int>(i) && getcurx(stdscr) < COLS - 1)
      addch(' ');
  }
  attrset(A_NORMAL);
  refresh();
}

std::vector<Key> Screen::keys(bool& ended) {
  std::vector<Key> pressed;
  wint_t code = 0;
  int found = ERR;
  while ((found = get_wch(&code)) != ERR) {
    if (found == KEY_CODE_YES)
      pressed.push_back({kind_of(static_cast<int>(code)), ""});
    else
      pressed.push_back(key_of(code));
  }
  // Without a key there is nothing to read, unless nobody is at the other end any more.
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  ended = poll(&input, 1, 0) == 1 && (input.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
  return pressed;
}

}  // namespace lockstep::cli
