/// Output cams and cam tracks: MC_OutputCam, MC_CamTrack.
#pragma once

#include "fb/block.hpp"
#include "fb/execute_block.hpp"
#include "tech_objects/switching/cam_track.hpp"
#include "tech_objects/switching/output_cam.hpp"

namespace lockstep {

/// What both share. While Enable is TRUE the instance is in charge of its object and its inputs count in
/// every call. Inputs that are not permitted are told at Error, and the last ones that were go on; at the
/// beginning they start nothing, until Enable falls. One instance at a time per object. A restart of what the
/// object is assigned to ends the job: Error until Enable falls.
class SwitchingBlock : public Block {
 public:
  BOOL Enable{};
  BOOL Busy{};
  BOOL Error{};
  WORD ErrorID{};

  void call(std::int64_t now) noexcept final;

 protected:
  virtual std::span<const Pin> pin_table() const noexcept = 0;
  virtual bool wired() const noexcept = 0;
  /// The instance in charge of the object, which is wired.
  virtual const void* owner() const noexcept = 0;
  /// Why inputs of which each is permitted are not, with this object.
  virtual ErrorId refusal() const noexcept { return ErrorId::none; }
  /// Writes the inputs, which are permitted.
  virtual void request() const noexcept = 0;
  /// Whether an alarm has ended the processing.
  virtual bool faulty() const noexcept = 0;
  /// Enable has fallen: ends the processing, or has it come to its end.
  virtual void let_go() const noexcept = 0;
  virtual void show(bool in_charge) noexcept = 0;

 private:
  bool in_charge() const noexcept { return wired() && owner() == this; }
  ErrorId check() const noexcept;
  ErrorId take_over() noexcept;

  bool refused_ = false;  // at the beginning; until Enable falls
  ErrorId error_ = ErrorId::none;
};

namespace pin {

inline constexpr Pin kSwitchingBusy = out<&SwitchingBlock::Busy>("Busy", "the object is processed");
inline constexpr Pin kSwitchingError =
    out<&SwitchingBlock::Error>("Error", "an input is not permitted, or an alarm has ended the processing");
inline constexpr Pin kSwitchingErrorID = out<&SwitchingBlock::ErrorID>("ErrorID", "identifier of the error");

}  // namespace pin

/// Switches an output at positions while Enable is TRUE; its inputs act with the next MC_Servo.
/// @source S7-1500/S7-1500T measuring input and output cam functions, MC_OutputCam
/// @errors 16#8040, 16#8041 positions; 16#8042 Duration of a time cam; 16#800A Mode; 16#8007 Direction;
/// 16#800C a second instance; 16#8001 while an alarm has ended the processing; 16#800D the axis or encoder
/// has been restarted
struct MC_OutputCam final : SwitchingBlock {
  lockstep::OutputCam* OutputCam{};
  LREAL OnPosition{};
  LREAL OffPosition{};
  LREAL Duration{};
  DINT Mode = 1;
  DINT Direction = 1;
  BOOL CamOutput{};

  static constexpr std::string_view kName = "MC_OutputCam";
  static constexpr std::string_view kText = "Switches an output at positions of an axis or encoder.";
  static constexpr std::string_view kSource =
      "S7-1500/S7-1500T measuring input and output cam functions, MC_OutputCam";
  static constexpr Choice kModes[] = {
      {1, "normal"}, {2, "the output is inverted"}, {3, "on while Enable is TRUE"}};
  static constexpr Choice kDirections[] = {{1, "positive"}, {2, "negative"}, {3, "both"}};
  static constexpr auto kPins = pins(
      object<&MC_OutputCam::OutputCam>("OutputCam", kOutputCam, "output cam"),
      in<&SwitchingBlock::Enable>("Enable", Unit::kNone, kAny,
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
      out<&MC_OutputCam::CamOutput>("CamOutput", "the output is on"), pin::kSwitchingBusy,
      pin::kSwitchingError, pin::kSwitchingErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  bool wired() const noexcept override { return OutputCam != nullptr; }
  const void* owner() const noexcept override { return OutputCam->request.owner; }
  ErrorId refusal() const noexcept override { return OutputCam->refused(wanted()); }
  void request() const noexcept override { OutputCam->request = wanted(); }
  bool faulty() const noexcept override { return OutputCam->faulty(); }
  void let_go() const noexcept override { OutputCam->request = {}; }
  void show(bool in_charge) noexcept override { CamOutput = in_charge && OutputCam->output(); }

 private:
  OutputCamRequest wanted() const noexcept;
};

/// Switches an output along a cam track while Enable is TRUE; each call takes the data of the track over.
/// @source S7-1500/S7-1500T measuring input and output cam functions, MC_CamTrack
/// @errors 16#800A Mode; 16#800C a second instance; 16#8001 while an alarm has ended the processing; 16#800D
/// the axis or encoder has been restarted
struct MC_CamTrack final : SwitchingBlock {
  lockstep::CamTrack* CamTrack{};
  DINT Mode = 1;
  BOOL InvertOutput{};
  BOOL TrackOutput{};

  static constexpr std::string_view kName = "MC_CamTrack";
  static constexpr std::string_view kText = "Switches an output by up to 32 cams along a track that repeats.";
  static constexpr std::string_view kSource =
      "S7-1500/S7-1500T measuring input and output cam functions, MC_CamTrack";
  static constexpr Choice kModes[] = {{0, "changes and switching off act at once"},
                                      {1, "changes and switching off act at the end of the track"},
                                      {2, "the output is on"}};
  static constexpr auto kPins =
      pins(object<&MC_CamTrack::CamTrack>("CamTrack", kCamTrack, "cam track"),
           in<&SwitchingBlock::Enable>("Enable", Unit::kNone, kAny, "TRUE: the track is processed"),
           in<&MC_CamTrack::Mode>("Mode", Unit::kNone, kAny, "when changes act",
                                  {.error = ErrorId::mode, .choices = kModes}),
           in<&MC_CamTrack::InvertOutput>("InvertOutput", Unit::kNone, kAny, "TRUE: the output is inverted"),
           out<&MC_CamTrack::TrackOutput>("TrackOutput", "the output is on"), pin::kSwitchingBusy,
           pin::kSwitchingError, pin::kSwitchingErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  bool wired() const noexcept override { return CamTrack != nullptr; }
  const void* owner() const noexcept override { return CamTrack->request.owner; }
  void request() const noexcept override;
  bool faulty() const noexcept override { return CamTrack->faulty(); }
  void let_go() const noexcept override;
  void show(bool in_charge) noexcept override { TrackOutput = in_charge && CamTrack->output(); }
};

}  // namespace lockstep
