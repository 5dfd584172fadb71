// A network that does not take a datagram, for a program that is started with this library before its own: as
// soon as the file named by LOCKSTEP_HANG is there, sending to an LCM network fails if that says "fail", and
// else takes for ever. The first time is noted in a file of that name and ".reached".
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

bool is_multicast(const msghdr* message) {
  if (message == nullptr || message->msg_namelen < sizeof(sockaddr_in)) return false;
  sockaddr_in address{};
  std::memcpy(&address, message->msg_name, sizeof address);
  return address.sin_family == AF_INET && IN_MULTICAST(ntohl(address.sin_addr.s_addr));
}

bool fails(const char* mark) {
  char text[5] = {};
  const int file = ::open(mark, O_RDONLY | O_CLOEXEC);
  const bool read = file >= 0 && ::read(file, text, 4) == 4;
  if (file >= 0) ::close(file);
  return read && std::strcmp(text, "fail") == 0;
}

}  // namespace

extern "C" ssize_t sendmsg(int socket, const msghdr* message, int flags) {
  const char* const mark = std::getenv("LOCKSTEP_HANG");
  if (mark == nullptr || !is_multicast(message) || ::access(mark, F_OK) != 0)
    return ::syscall(SYS_sendmsg, socket, message, flags);
  const int reached = ::open((std::string(mark) + ".reached").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (reached >= 0) ::close(reached);
  if (fails(mark)) {
    errno = ENOBUFS;
    return -1;
  }
  while (::access(mark, F_OK) == 0) ::usleep(100'000);
  return ::syscall(SYS_sendmsg, socket, message, flags);
}
