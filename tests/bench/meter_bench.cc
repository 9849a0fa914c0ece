// SPDX-License-Identifier: Apache-2.0
// What a driver costs beside its wire: every tape of sample_data played without waiting, from
// identifying the meter to the reading. The bare line is the same tape asked for blindly.
//   lightcal_bench_meter SAMPLE_DATA [benchmark options]
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>

#include "lightcal_devices/meters/meter_table.h"
#include "lightcal_devices/transport/replay.h"
#include "lightcal_devices/transport/tape_codec.h"

namespace {

using namespace lightcal;
using namespace lightcal::devices;
constexpr std::chrono::milliseconds kNoWait{0};
constexpr std::size_t kAnyLength = 1U << 20U;

void BareLine(benchmark::State& state, const Tape& tape) {
  for (auto _ : state) {
    ReplayTransport line(tape);
    for (const TapeExchange& exchange : tape.exchanges) {
      switch (exchange.operation) {
        case TapeOperation::kWrite:
          benchmark::DoNotOptimize(line.Write(exchange.sent, kNoWait));
          break;
        case TapeOperation::kRead:
          benchmark::DoNotOptimize(line.Read(kAnyLength, kNoWait));
          break;
        case TapeOperation::kControl:
          benchmark::DoNotOptimize(line.Control(exchange.verb, exchange.sent, kAnyLength, kNoWait));
          break;
      }
    }
  }
}

void WholeReading(benchmark::State& state, const Tape& tape, const MeterRow& row) {
  MeterSetup setup;
  setup.timing.live = false;
  std::istringstream settings(tape.settings);
  for (std::string line; std::getline(settings, line);) {
    const auto equals = line.find('=');
    setup.options[line.substr(0, equals)] = line.substr(equals + 1);
  }
  for (auto _ : state) {
    ReplayTransport line(tape);
    const auto meter = row.make(line, setup);
    auto identity = meter->Identify();
    auto reading = meter->Measure(Cancellation());
    if (!reading) {
      state.SkipWithError(reading.error().message.c_str());
      return;
    }
    benchmark::DoNotOptimize(reading);
  }
}

void RegisterTape(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto tape = TapeFromText(text, path.string());
  if (!tape) {
    std::cerr << path << ": " << tape.error().message << "\n";
    return;
  }
  const MeterRow* row = FindDriver(tape->driver);
  if (row == nullptr) return;
  const std::string name = path.stem().string();
  benchmark::RegisterBenchmark(("bare_line/" + name).c_str(),
                               [tape = *tape](benchmark::State& s) { BareLine(s, tape); });
  benchmark::RegisterBenchmark(
      ("reading/" + name).c_str(),
      [tape = *tape, row](benchmark::State& s) { WholeReading(s, tape, *row); });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: lightcal_bench_meter SAMPLE_DATA [benchmark options]\n";
    return 2;
  }
  for (const auto& entry : std::filesystem::directory_iterator(std::string(argv[1]) + "/tapes")) {
    if (entry.path().extension() == ".tape") RegisterTape(entry.path());
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
