/// A key that several controllers share, and the code with which they sign.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lockstep {

/// Empty: there is none.
using SharedKey = std::vector<std::uint8_t>;

/// HMAC-SHA-256.
/// @source RFC 2104, FIPS 180-4
using MessageCode = std::array<std::uint8_t, 32>;
MessageCode code_of(std::span<const std::uint8_t> bytes, const SharedKey& key) noexcept;

/// Whether two codes are the same, in a time that tells nothing of where they differ.
bool same_code(const MessageCode& a, const MessageCode& b) noexcept;

/// Reads a key from a file: its bytes, less white space at the end; 16 to 1024 of them. The file must be
/// readable by its owner alone.
/// @throws std::runtime_error that names the file and tells why
SharedKey read_key_file(const std::string& path);

}  // namespace lockstep
