/// Answers one Modbus request from the process image: no sockets of clients, no threads. A request has the
/// header of Modbus TCP, also one that came over a serial line.
/// @source Modbus application protocol V1.1b3, 6; Modbus messaging on TCP/IP V1.0b, 3.1.3
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hmi_bridge/audit/log.hpp"
#include "hmi_bridge/modbus/counters.hpp"
#include "hmi_bridge/modbus/identity.hpp"
#include "hmi_bridge/modbus/map.hpp"
#include "scheduler/process_image.hpp"

namespace lockstep {

/// Sizes of a frame on TCP [byte]: its MBAP header with the unit id, and all of it.
inline constexpr std::size_t kModbusHeader = 7;
inline constexpr std::size_t kModbusFrame = 260;

/// Length [byte] of the frame that begins with these bytes, as its MBAP header says; 0 if that cannot be told
/// yet; none if it is not Modbus (protocol id not 0, or a length that no frame has).
std::optional<std::size_t> modbus_frame_length(std::span<const std::uint8_t> bytes) noexcept;

/// The exceptions that this server answers with.
enum class ModbusException : std::uint8_t {
  none = 0,
  illegal_function = 1,
  illegal_data_address = 2,
  illegal_data_value = 3,
  server_device_failure = 4  ///< a write that no tick would take any more
};

/// Who asks, for the audit log.
struct ModbusPeer {
  std::string from;    ///< address and port, or the line
  std::string source;  ///< the address alone, or the line
};

/// Carries out requests on an image. Not copyable; everything is called by one thread, the bridge's of the
/// image.
class ModbusResponder {
 public:
  /// The maps, the image and the counters outlive it. The signals of the maps are those of the image.
  /// @param counters of the server, for the entries that show them; nullptr: they show 0
  ModbusResponder(const ModbusUnits& units, ProcessImage& image, ModbusIdentity identity = {},
                  const ModbusCounters* counters = nullptr);
  ModbusResponder(const ModbusResponder&) = delete;
  ModbusResponder& operator=(const ModbusResponder&) = delete;

  /// Carries out a request and gives the frame to answer with, valid until the next call. `frame` is one
  /// whole frame, by modbus_frame_length.
  std::span<const std::uint8_t> answer(std::span<const std::uint8_t> frame);

  /// From here on each write, carried out or refused, is told to a log. Both outlive this.
  /// @param names of the signals of the image
  void audit_to(AuditLog& log, std::span<const std::string> names) noexcept {
    audit_ = &log;
    names_ = names;
  }
  /// Who asks from here on; outlives the next `answer`.
  void set_peer(const ModbusPeer& peer) noexcept { peer_ = &peer; }

  /// From here on writes that would be carried out are answered with exception 4: the cycle ends.
  void refuse_writes() noexcept { refuses_writes_ = true; }

  /// What the last answer said.
  ModbusException exception() const noexcept { return exception_; }

 private:
  using Bytes = std::span<const std::uint8_t>;

  ModbusException perform(Bytes pdu);
  ModbusException read_bits(ModbusTable table, Bytes pdu);
  ModbusException read_registers(ModbusTable table, std::uint32_t address, std::uint32_t count);
  std::uint32_t put_plain(ModbusTable table, std::uint32_t address, std::uint32_t maximum,
                          std::uint8_t* bytes) const noexcept;
  ModbusException write_one_bit(Bytes pdu);
  ModbusException write_many_bits(Bytes pdu);
  ModbusException write_one_register(Bytes pdu);
  ModbusException write_many_registers(Bytes pdu);
  ModbusException write_bits(std::uint32_t address, std::uint32_t count, Bytes bits);
  ModbusException write_registers(std::uint32_t address, Bytes words);
  ModbusException mask_register(std::uint32_t address, std::uint16_t and_mask, std::uint16_t or_mask);
  ModbusException mask_bits(const ModbusEntry& first, std::uint16_t and_mask, std::uint16_t or_mask);
  ModbusException write_and_read_registers(Bytes pdu);
  ModbusException post();
  ModbusException identify_us(Bytes pdu);
  std::uint8_t* begin_list(std::size_t bytes);
  ModbusException echo(Bytes part);

  ModbusException check_read(ModbusTable table, std::uint32_t address, std::uint32_t count) const;
  ModbusException check_write(ModbusTable table, std::uint32_t address, std::uint32_t count) const;
  ModbusException stage_registers(std::uint32_t address, Bytes words);
  ModbusException stage_bits(const ModbusEntry& first, std::uint16_t word);
  ModbusException refuse(const ModbusEntry& entry, ModbusWords words,
                         std::optional<Value> value = std::nullopt) noexcept;
  AuditEntry audit_entry() const;
  void audit_writes();
  void audit_refusal(Bytes pdu);
  void name_refused(AuditEntry& told) const;
  Value value_of(const ModbusEntry& entry) const;
  ModbusWords words_of(const ModbusEntry& entry) const;

  const ModbusUnits units_;
  const ModbusMap* map_;  ///< of the request at hand
  ProcessImage& image_;
  const ModbusIdentity identity_;
  const ModbusCounters* counters_;
  AuditLog* audit_ = nullptr;
  std::span<const std::string> names_;
  const ModbusPeer* peer_ = nullptr;
  std::uint8_t unit_ = 0;  ///< of the request at hand
  std::vector<SignalWrite> batch_;
  std::array<std::uint8_t, kModbusFrame> reply_{};
  bool refuses_writes_ = false;
  struct Refused {
    const ModbusEntry* entry = nullptr;  ///< that has not taken its value; nullptr: none
    ModbusWords words{};                 ///< of the value
    std::optional<Value> value;          ///< if it does not stand in these
  };
  Refused refused_;       ///< of the request at hand
  std::size_t size_ = 0;  ///< of what the reply has behind its header [byte]
  ModbusException exception_ = ModbusException::none;
};

}  // namespace lockstep
