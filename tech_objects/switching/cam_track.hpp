/// A cam track: TO_CamTrack. Up to 32 cams switch one output along a track that repeats in both directions.
/// @source S7-1500/S7-1500T measuring input and output cam functions, cam track
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "tech_objects/switching/switching_object.hpp"

namespace lockstep {

/// What MC_CamTrack wants; written in every call by the one instance in charge.
struct CamTrackRequest {
  const void* owner = nullptr;  ///< nullptr: none
  BOOL enable{};
  CamTrackMode mode = CamTrackMode::next_track;
  BOOL invert{};
  BOOL called{};  ///< the data of the object are to be taken over
};

class CamTrack final : public SwitchingObject<CamTrackData, ProcessingEnd::cam_track> {
 public:
  static constexpr std::size_t kCams = 32;

  CamTrack(std::string name, DB_ANY number);

  CamTrackRequest request;

  /// With Mode 1 the processing goes on to the end of the track.
  void servo(std::int64_t now) noexcept override;

 private:
  /// All edges of a servo cycle; what does not fit leaves the state at its end right.
  struct Edges {
    static constexpr std::size_t kMaximum = 2 * kCams;
    struct Edge {
      double time;
      std::uint8_t cam;
      bool on;
    };
    std::array<Edge, kMaximum> list;
    std::size_t count = 0;
    void add(std::size_t cam, const SwitchingEdges& edges) noexcept;
  };

  void end() noexcept override;
  void show_processing() noexcept override;
  int alarm_of() const noexcept;
  bool data_fit(const TO_Struct_CamTrack_Parameter& parameter) const noexcept;
  bool counts(const TO_Struct_CamTrack_Parameter& parameter, std::size_t cam) const noexcept;
  SwitchingShape shape(std::size_t cam) const noexcept;
  void take_data() noexcept;
  void process(Edges& edges) noexcept;
  void begin(Edges& edges, const Stretch& at, bool inclusive) noexcept;
  void step(Edges& edges, const Stretch& distance) noexcept;
  void step_to_border(Edges& edges, const Stretch& distance) noexcept;
  double place_of(double position) const noexcept;
  void stop(double time, Edges& edges) noexcept;
  void show(const Edges& edges) noexcept;

  std::array<SingleCam, kCams> cams_{};
  TO_Struct_CamTrack_Parameter active_data_;   // by which the track runs
  TO_Struct_CamTrack_Parameter waiting_data_;  // with the next track
  bool waiting_ = false;
  double place_ = 0.0;       // in the track [u], at this tick
  std::uint32_t shown_ = 0;  // cams that are on, as shown at the tick before
};

}  // namespace lockstep
