/// Function blocks: the common base and the list of types.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "fb/pin.hpp"
#include "tech_objects/arithmetic/cache_line.hpp"

namespace lockstep {

class EncoderSaving;
struct Job;

/// An instance of a function block. Created at load time; `call` is the only thing that happens in the cycle.
class alignas(kCacheLine) Block {
 public:
  virtual ~Block() = default;
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  /// One call of the instance, in the thread of the cycle. Outputs change only here.
  /// @param now time of the tick [ns]
  virtual void call(std::int64_t now) noexcept = 0;

  /// Takes up what a controller has once for all its instances. At load time, once.
  virtual void connect(EncoderSaving& /*saving*/) noexcept {}

  /// The job that the outputs show; nullptr: none, or a block whose jobs tell nothing besides. Thread: the
  /// cycle.
  virtual const Job* shown_job() const noexcept { return nullptr; }

 protected:
  Block() = default;
};

/// The error of the first input whose present value is not permitted; none if all are.
ErrorId first_error(std::span<const Pin> pins, const Block& block) noexcept;

/// A type of function block, as the project file and `lockstep describe` see it.
struct BlockType {
  std::string_view name;    ///< published name
  std::string_view text;    ///< what it does, in one sentence
  std::string_view source;  ///< manual section or clause
  std::span<const Pin> pins;
  std::unique_ptr<Block> (*create)();

  /// The pin with a name, without regard to case; nullptr if there is none.
  const Pin* find_pin(std::string_view pin_name) const noexcept;
};

/// All function blocks, in the order in which `describe` lists them.
std::span<const BlockType> block_types() noexcept;

/// The type with a published name, without regard to case; nullptr if there is none.
const BlockType* find_block_type(std::string_view name) noexcept;

/// Entry of the list of types for the block T, which has kName, kText, kSource and kPins.
template <class T>
constexpr BlockType block_type() {
  return {T::kName, T::kText, T::kSource, T::kPins, [] { return std::unique_ptr<Block>(new T); }};
}

}  // namespace lockstep
