// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/torchbearer/meter.h"

#include <array>
#include <utility>

#include "lightcal_devices/meters/frame_search.h"
#include "lightcal_devices/meters/torchbearer/reading.h"

namespace lightcal::devices::torchbearer {
namespace {

constexpr std::array kIdArgument = {std::byte{0x18}};
constexpr int kMostOthers = 8;         // messages passed over while waiting for an answer
constexpr int kMostMeasurements = 20;  // until the automatic exposure fits
constexpr int kExposureSilences = 10;  // a dim light is exposed for seconds

FrameSearch HeaderSearch(const MeterTiming& timing, int silences) {
  return {.frame_bytes = kHeaderBytes,
          .may_begin = MayBeginMessage,
          .most_bytes = kLongestMessageBytes,
          .waits = silences,
          .wait = timing.reply,
          .hint = "is the spectrometer switched on, and is this its port?",
          .passing = ""};
}

tl::unexpected<Error> BadlyExposed(Exposure exposure, const std::string& device) {
  if (exposure == Exposure::kOver) {
    return Refused("over_exposed", device,
                   "too bright for the shortest exposure; move back or add a neutral filter");
  }
  return Refused("under_exposed", device, "too dark for the longest exposure; move closer");
}

bool Is(unsigned type, MessageType wanted) { return type == static_cast<unsigned>(wanted); }

}  // namespace

std::string TorchbearerMeter::DeviceName() const {
  return "torchbearer:" + (serial_.empty() ? id_ : serial_);
}

Result<void> TorchbearerMeter::Send(MessageType type, std::span<const std::byte> data) {
  return transport_.Write(EncodeRequest(type, data), timing_.reply);
}

Result<TorchbearerMeter::Answer> TorchbearerMeter::ReadMessage(int silences,
                                                               const Cancellation& cancellation) {
  auto bytes = FindFrame(transport_, HeaderSearch(timing_, silences), cancellation);
  if (!bytes) return Propagate(std::move(bytes));
  const auto length = MessageLength(*bytes);
  if (!length) return tl::unexpected(length.error());
  const auto rest = StreamReader(transport_).ReadExactly(*length - kHeaderBytes, timing_.reply);
  if (!rest && rest.error().code == fault::kTimeout) {
    return Failed(std::string(kBadReply), DeviceName(),
                  "a message broke off after its length; is the cable firm?");
  }
  if (!rest) return tl::unexpected(rest.error());
  bytes->insert(bytes->end(), rest->begin(), rest->end());
  const auto message = DecodeMessage(*bytes);
  if (!message) return tl::unexpected(message.error());
  return Answer{message->type, Bytes(message->data.begin(), message->data.end())};
}

Result<Bytes> TorchbearerMeter::ReadAnswer(MessageType type, const Cancellation& cancellation) {
  for (int i = 0; i < kMostOthers; ++i) {
    auto message = ReadMessage(1, cancellation);
    if (!message) return Propagate(std::move(message));
    if (Is(message->type, type)) return std::move(message->data);
  }
  return Failed(std::string(kBadReply), DeviceName(),
                "sends other messages than the one asked for; plug it in anew and try again");
}

template <class Decode>
auto TorchbearerMeter::Ask(MessageType type, std::span<const std::byte> data,
                           const Cancellation& cancellation, Decode decode)
    -> decltype(decode(Bytes())) {
  const auto once = [&]() -> decltype(decode(Bytes())) {
    if (auto sent = Send(type, data); !sent) return tl::unexpected(sent.error());
    const auto answer = ReadAnswer(type, cancellation);
    if (!answer) return tl::unexpected(answer.error());
    return decode(*answer);
  };
  auto answer = once();
  if (answer || answer.error().code != kBadReply) return answer;
  StreamReader(transport_).Drain(timing_.drain);
  return once();
}

Result<MeterIdentity> TorchbearerMeter::Identify() {
  ForgetQueued(transport_);
  auto id = Ask(MessageType::kDeviceId, kIdArgument, Cancellation(),
                [](const Bytes& data) { return DecodeDeviceId(data); });
  if (!id) return Propagate(std::move(id));
  id_ = *std::move(id);
  return MeterIdentity{id_, "", {}};
}

// An order: not repeated when its answer is damaged.
Result<void> TorchbearerMeter::SetExposure(bool automatic, const Cancellation& cancellation) {
  const std::array mode = {automatic ? std::byte{1} : std::byte{0}};
  if (auto sent = Send(MessageType::kSetExposureMode, mode); !sent) return sent;
  const auto answer = ReadAnswer(MessageType::kSetExposureMode, cancellation);
  if (!answer) return tl::unexpected(answer.error());
  return DecodeAccepted(*answer);
}

Result<std::optional<Measurement>> TorchbearerMeter::NextMeasurement(
    const Cancellation& cancellation) {
  const auto message = ReadMessage(kExposureSilences, cancellation);
  if (!message) return tl::unexpected(message.error());
  // The late acknowledgement of an earlier end has ended this stream.
  if (Is(message->type, MessageType::kStop)) {
    if (auto sent = Send(MessageType::kData); !sent) return tl::unexpected(sent.error());
  }
  if (!Is(message->type, MessageType::kData)) return std::nullopt;
  auto measurement = DecodeMeasurement(message->data, *range_);
  if (!measurement) return Propagate(std::move(measurement));
  return *std::move(measurement);
}

Result<Measurement> TorchbearerMeter::MeasureStreaming(const Cancellation& cancellation) {
  if (auto sent = Send(MessageType::kData); !sent) return tl::unexpected(sent.error());
  bool forgiven = false;
  Exposure last = Exposure::kUnder;
  for (int i = 0; i < kMostMeasurements; ++i) {
    auto next = NextMeasurement(cancellation);
    if (!next && (next.error().code != kBadReply || forgiven)) return Propagate(std::move(next));
    if (!next) {
      forgiven = true;
      continue;
    }
    if (!*next) continue;
    if ((*next)->exposure == Exposure::kOk) return **std::move(next);
    last = (*next)->exposure;
  }
  return BadlyExposed(last, DeviceName());
}

Result<void> TorchbearerMeter::StopStreaming(bool acknowledged) {
  if (auto sent = Send(MessageType::kStop); !sent) return sent;
  if (!acknowledged) {
    StreamReader(transport_).Drain(timing_.drain);
    return {};
  }
  if (auto ended = ReadAnswer(MessageType::kStop, Cancellation()); !ended) {
    return tl::unexpected(ended.error());
  }
  return {};
}

Result<void> TorchbearerMeter::Restore(bool acknowledged, bool was_automatic) {
  const auto stopped = StopStreaming(acknowledged);
  if (was_automatic) return stopped;
  const auto manual = SetExposure(false, Cancellation());
  return stopped ? manual : stopped;
}

Result<MeterReading> TorchbearerMeter::Measure(const Cancellation& cancellation) {
  if (id_.empty()) {
    if (auto identity = Identify(); !identity) return Propagate(std::move(identity));
  }
  ForgetQueued(transport_);
  if (!range_) {
    auto range = Ask(MessageType::kRange, {}, cancellation,
                     [](const Bytes& data) { return DecodeRange(data); });
    if (!range) return Propagate(std::move(range));
    range_ = *range;
  }
  const auto was_automatic = Ask(MessageType::kGetExposureMode, {}, cancellation,
                                 [](const Bytes& data) { return DecodeExposureMode(data); });
  if (!was_automatic) return tl::unexpected(was_automatic.error());
  const auto measure = [&]() -> Result<Measurement> {
    if (!*was_automatic) {
      if (auto set = SetExposure(true, cancellation); !set) return tl::unexpected(set.error());
    }
    return MeasureStreaming(cancellation);
  };
  const auto measurement = measure();
  if (!measurement && IsGone(measurement.error())) return tl::unexpected(measurement.error());
  const auto restored = Restore(measurement.has_value(), *was_automatic);
  if (!measurement) return tl::unexpected(measurement.error());
  MeterReading reading = ReadingFromMeasurement(*measurement, *range_, DeviceName());
  if (!restored) {
    reading.warnings.push_back({"not_restored", DeviceName(),
                                "the stream or the exposure could not be given back (" +
                                    restored.error().message + "); plug the device in anew"});
  }
  return reading;
}

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<TorchbearerMeter>(transport, setup);
}

}  // namespace lightcal::devices::torchbearer
