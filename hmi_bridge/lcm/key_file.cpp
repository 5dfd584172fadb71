#include "hmi_bridge/lcm/key_file.hpp"

#include <fcntl.h>
#include <nettle/hmac.h>
#include <nettle/memops.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace lockstep {
namespace {

constexpr std::size_t kShortest = 16;
constexpr std::size_t kLongest = 1024;

[[noreturn]] void refuse_key(const std::string& path, const std::string& why) {
  throw std::runtime_error("key file " + path + ": " + why);
}

bool is_space(std::uint8_t byte) noexcept {
  return byte == ' ' || byte == '\t' || byte == '\r' || byte == '\n';
}

}  // namespace

MessageCode code_of(std::span<const std::uint8_t> bytes, const SharedKey& key) noexcept {
  hmac_sha256_ctx context;
  hmac_sha256_set_key(&context, key.size(), key.data());
  hmac_sha256_update(&context, bytes.size(), bytes.data());
  MessageCode code{};
  hmac_sha256_digest(&context, code.size(), code.data());
  return code;
}

bool same_code(const MessageCode& a, const MessageCode& b) noexcept {
  return memeql_sec(a.data(), b.data(), a.size()) != 0;
}

SharedKey read_key_file(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (file < 0) refuse_key(path, std::generic_category().message(errno));
  struct stat status {};
  SharedKey key(kLongest + 2);
  const bool plain = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
  const ssize_t size = plain ? ::read(file, key.data(), key.size()) : -1;
  ::close(file);
  if (!plain) refuse_key(path, "is no file but a folder, a pipe, a device or a socket");
  if (size < 0) refuse_key(path, "cannot be read");
  if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    refuse_key(path, "others than its owner may read it; allowed: chmod 600");
  key.resize(static_cast<std::size_t>(size));
  while (!key.empty() && is_space(key.back())) key.pop_back();
  if (key.size() < kShortest || key.size() > kLongest)
    refuse_key(path, "it has " + std::to_string(key.size()) +
                         " bytes; allowed: " + std::to_string(kShortest) + " to " + std::to_string(kLongest));
  return key;
}

}  // namespace lockstep
