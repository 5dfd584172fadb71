/// Output cams and cam tracks: MC_OutputCam, MC_CamTrack.
#pragma once

#include "fb/block.hpp"
#include "fb/execute_block.hpp"
#include "tech_objects/cam_track.hpp"
#include "tech_objects/output_cam.hpp"

namespace lockstep {

/// Switches an output at positions while Enable is TRUE; its inputs count in every call, and act with the
/// next MC_Servo. Inputs that are not permitted are told at Error, and the last ones that were go on; at the
/// beginning they start nothing. One instance at a time per cam.
/// @source S7-1500/S7-1500T measuring input and output cam functions, MC_OutputCam
/// @errors 16#8040, 16#8041 positions; 16#8042 Duration of a time cam; 16#800A Mode; 16#8007 Direction;
/// 16#800C a second instance; 16#8001 while an alarm has ended the processing
struct MC_OutputCam final : Block {
  lockstep::OutputCam* OutputCam{};
  BOOL Enable{};
  LREAL OnPosition{};
  LREAL OffPosition{};
  LREAL Duration{};
  DINT Mode = 1;
  DINT Direction = 1;
  BOOL CamOutput{};
  BOOL Busy{};
  BOOL Error{};
  WORD ErrorID{};

  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "MC_OutputCam";
  static constexpr std::string_view kText = "Switches an output at positions of an axis or encoder.";
  static constexpr std::string_view kSource =
      "S7-1500/S7-1500T measuring input and output cam functions, MC_OutputCam";
  static constexpr Choice kModes[] = {
      {1, "normal"}, {2, "the output is inverted"}, {3, "on while Enable is TRUE"}};
  static constexpr Choice kDirections[] = {{1, "positive"}, {2, "negative"}, {3, "both"}};
  static constexpr auto kPins = pins(
      object<&MC_OutputCam::OutputCam>("OutputCam", kOutputCam, "output cam"),
      in<&MC_OutputCam::Enable>("Enable", Unit::kNone, kAny,
                                "TRUE: the cam is processed; its inputs count in every call"),
      in<&MC_OutputCam::OnPosition>("OnPosition", Unit::kPosition, {-kPositionRange, kPositionRange},
                                    "where the cam begins", {.error = ErrorId::on_position}),
      in<&MC_OutputCam::OffPosition>("OffPosition", Unit::kPosition, {-kPositionRange, kPositionRange},
                                     "where a distance cam ends; less than OnPosition: it is on beyond both",
                                     {.error = ErrorId::off_position}),
      in<&MC_OutputCam::Duration>("Duration", Unit::kMilliseconds, {0.0, 1e12},
                                  "how long a time cam is on, greater than 0 with one",
                                  {.error = ErrorId::cam_duration}),
      in<&MC_OutputCam::Mode>("Mode", Unit::kNone, kAny, "how the output shows the cam",
                              {.error = ErrorId::mode, .choices = kModes}),
      in<&MC_OutputCam::Direction>("Direction", Unit::kNone, kAny, "direction in which it switches",
                                   {.error = ErrorId::direction, .choices = kDirections}),
      out<&MC_OutputCam::CamOutput>("CamOutput", "the output is on"),
      out<&MC_OutputCam::Busy>("Busy", "the cam is processed"),
      out<&MC_OutputCam::Error>("Error", "an input is not permitted, or an alarm has ended the processing"),
      out<&MC_OutputCam::ErrorID>("ErrorID", "identifier of the error"));

 private:
  ErrorId check() const noexcept;
  ErrorId take_over() noexcept;

  bool refused_ = false;  // at the beginning; until Enable falls
  ErrorId error_ = ErrorId::none;
};

/// Switches an output along a cam track while Enable is TRUE; each call takes the data of the track over. One
/// instance at a time per track.
/// @source S7-1500/S7-1500T measuring input and output cam functions, MC_CamTrack
/// @errors 16#800A Mode; 16#800C a second instance; 16#8001 while an alarm has ended the processing
struct MC_CamTrack final : Block {
  lockstep::CamTrack* CamTrack{};
  BOOL Enable{};
  DINT Mode = 1;
  BOOL InvertOutput{};
  BOOL TrackOutput{};
  BOOL Busy{};
  BOOL Error{};
  WORD ErrorID{};

  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "MC_CamTrack";
  static constexpr std::string_view kText = "Switches an output by up to 32 cams along a track that repeats.";
  static constexpr std::string_view kSource =
      "S7-1500/S7-1500T measuring input and output cam functions, MC_CamTrack";
  static constexpr Choice kModes[] = {{0, "changes and switching off act at once"},
                                      {1, "changes and switching off act at the end of the track"},
                                      {2, "the output is on"}};
  static constexpr auto kPins = pins(
      object<&MC_CamTrack::CamTrack>("CamTrack", kCamTrack, "cam track"),
      in<&MC_CamTrack::Enable>("Enable", Unit::kNone, kAny, "TRUE: the track is processed"),
      in<&MC_CamTrack::Mode>("Mode", Unit::kNone, kAny, "when changes act",
                             {.error = ErrorId::mode, .choices = kModes}),
      in<&MC_CamTrack::InvertOutput>("InvertOutput", Unit::kNone, kAny, "TRUE: the output is inverted"),
      out<&MC_CamTrack::TrackOutput>("TrackOutput", "the output is on"),
      out<&MC_CamTrack::Busy>("Busy", "the track is processed"),
      out<&MC_CamTrack::Error>("Error", "an input is not permitted, or an alarm has ended the processing"),
      out<&MC_CamTrack::ErrorID>("ErrorID", "identifier of the error"));

 private:
  ErrorId check() const noexcept;
  ErrorId take_over() noexcept;

  bool refused_ = false;  // at the beginning; until Enable falls
  ErrorId error_ = ErrorId::none;
};

}  // namespace lockstep
