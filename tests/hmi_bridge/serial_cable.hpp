/// Two serial lines with a cable between them, made of pseudo-terminals.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/eventfd.h>
#include <termios.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "hmi_bridge/modbus/serial.hpp"

namespace lockstep {

/// A frame with the check that it has on a line.
inline std::vector<std::uint8_t> with_check(std::vector<std::uint8_t> frame) {
  const std::uint16_t crc = modbus_crc(frame);
  frame.push_back(static_cast<std::uint8_t>(crc));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8));
  return frame;
}

/// One end, which a test holds by itself: what it writes comes in at the device `name`.
class PseudoTerminal {
 public:
  PseudoTerminal() : control_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    EXPECT_EQ(::grantpt(control_), 0);
    EXPECT_EQ(::unlockpt(control_), 0);
    char name[128] = "";
    EXPECT_EQ(::ptsname_r(control_, name, sizeof name), 0);
    name_ = name;
    // Held open, so that it lives on when its user closes it; without echo.
    line_ = ::open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios settings{};
    ::tcgetattr(line_, &settings);
    ::cfmakeraw(&settings);
    ::tcsetattr(line_, TCSANOW, &settings);
  }
  ~PseudoTerminal() {
    ::close(line_);
    ::close(control_);
  }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  const std::string& name() const { return name_; }
  int control() const { return control_; }

  void send(const std::vector<std::uint8_t>& bytes) const {
    EXPECT_EQ(::write(control_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  /// As many bytes as asked for, or what has come when nothing more does for `timeout` [ms].
  std::vector<std::uint8_t> receive(std::size_t count, int timeout = 20'000) const {
    std::vector<std::uint8_t> bytes;
    pollfd place{control_, POLLIN, 0};
    while (bytes.size() < count && ::poll(&place, 1, timeout) > 0) {
      std::uint8_t byte = 0;
      if (::read(control_, &byte, 1) != 1) break;
      bytes.push_back(byte);
    }
    return bytes;
  }

 private:
  int control_;
  int line_ = -1;
  std::string name_;
};

/// Carries bytes between two of them until it ends.
class SerialCable {
 public:
  SerialCable() : thread_([this] { carry(); }) {}
  ~SerialCable() {
    const std::uint64_t one = 1;
    EXPECT_EQ(::write(end_, &one, sizeof one), 8);
    thread_.join();
    ::close(end_);
  }
  const std::string& left() const { return left_.name(); }
  const std::string& right() const { return right_.name(); }

 private:
  static void copy(int from, int to) {
    std::uint8_t bytes[256];
    const ssize_t count = ::read(from, bytes, sizeof bytes);
    if (count <= 0) return;
    EXPECT_EQ(::write(to, bytes, static_cast<std::size_t>(count)), count);
  }
  void carry() {
    for (;;) {
      pollfd places[] = {{end_, POLLIN, 0}, {left_.control(), POLLIN, 0}, {right_.control(), POLLIN, 0}};
      if (::poll(places, 3, -1) < 0 || places[0].revents != 0) return;
      if ((places[1].revents & POLLIN) != 0) copy(left_.control(), right_.control());
      if ((places[2].revents & POLLIN) != 0) copy(right_.control(), left_.control());
    }
  }

  PseudoTerminal left_, right_;
  int end_ = ::eventfd(0, EFD_CLOEXEC);
  std::thread thread_;
};

}  // namespace lockstep
