// SPDX-License-Identifier: Apache-2.0
// Illuminance per candela of a rectangle by GSL's integration. Table as own_area.cc.
//   E/I = (1/A) integral of (normal . to)(to_z) / r^4 over the rectangle, `to` towards it
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_monte_plain.h>
#include <gsl/gsl_monte_vegas.h>

#include <limits>

#include "rows.h"

namespace {

constexpr double kHalfWidth = 0.8, kHalfHeight = 0.6;
constexpr double kArea = 4.0 * kHalfWidth * kHalfHeight;
constexpr std::size_t kIntervals = 200;

double Integrand(const page::Numbers& meter, double x, double y) {
  const double tx = x - meter[0], ty = y - meter[1], tz = -meter[2];
  const double r2 = tx * tx + ty * ty + tz * tz;
  const double at_meter = meter[3] * tx + meter[4] * ty + meter[5] * tz;
  return at_meter * -tz / (r2 * r2) / kArea;
}

double ForMonteCarlo(double* at, std::size_t, void* meter) {
  return Integrand(*static_cast<const page::Numbers*>(meter), at[0], at[1]);
}

// Adaptive along x of adaptive along y.
class Nested {
 public:
  double Integrate(const page::Numbers& meter, double tolerance) {
    meter_ = &meter;
    tolerance_ = tolerance;
    return Along(
        -kHalfWidth, kHalfWidth,
        [](double x, void* self) {
          auto* nested = static_cast<Nested*>(self);
          nested->x_ = x;
          return nested->Along(
              -kHalfHeight, kHalfHeight,
              [](double y, void* same) {
                const auto* inside = static_cast<const Nested*>(same);
                return Integrand(*inside->meter_, inside->x_, y);
              },
              nested->inner_);
        },
        outer_);
  }

 private:
  double Along(double from, double to, double (*value)(double, void*),
               gsl_integration_workspace* workspace) {
    gsl_function function{value, this};
    double result = 0.0, error = 0.0;
    gsl_integration_qag(&function, from, to, 0.0, tolerance_, kIntervals, GSL_INTEG_GAUSS15,
                        workspace, &result, &error);
    return result;
  }

  const page::Numbers* meter_ = nullptr;
  double tolerance_ = 1e-3;
  double x_ = 0.0;
  gsl_integration_workspace* outer_ = gsl_integration_workspace_alloc(kIntervals);
  gsl_integration_workspace* inner_ = gsl_integration_workspace_alloc(kIntervals);
};

void MonteCarlo(const std::vector<page::Numbers>& table, const page::Rows& rows) {
  gsl_rng* random = gsl_rng_alloc(gsl_rng_mt19937);
  gsl_monte_plain_state* plain = gsl_monte_plain_alloc(2);
  gsl_monte_vegas_state* vegas = gsl_monte_vegas_alloc(2);
  double low[] = {-kHalfWidth, -kHalfHeight}, high[] = {kHalfWidth, kHalfHeight};
  for (const std::size_t calls : {16U, 64U, 256U, 1024U, 4096U, 16384U}) {
    const auto with = [&](auto* state, auto integrate) {
      return [&, state, integrate, calls](std::size_t i) {
        auto* meter = const_cast<page::Numbers*>(&table[i]);  // GSL takes no const
        gsl_monte_function function{ForMonteCarlo, 2, meter};
        double result = 0.0, error = 0.0;
        integrate(&function, low, high, 2, calls, random, state, &result, &error);
        return result;
      };
    };
    const std::string setting = std::to_string(calls) + " samples";
    rows.PrintEach("plain Monte Carlo (GSL)", setting, with(plain, gsl_monte_plain_integrate));
    if (calls < 256U) continue;
    rows.PrintEach("VEGAS (GSL)", setting, with(vegas, [](auto* f, auto... rest) {
                     return gsl_monte_vegas_integrate(f, rest...);
                   }));
  }
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return EXIT_FAILURE;
  gsl_set_error_handler_off();
  const auto table = page::ReadTable(words[1]);
  const page::Rows rows(table, page::ErrorScale::kRelative);
  Nested nested;
  for (const auto& [name, tolerance] : {std::pair{"1e-1", 1e-1},
                                        {"1e-3", 1e-3},
                                        {"1e-6", 1e-6},
                                        {"1e-9", 1e-9},
                                        {"1e-12", 1e-12}}) {
    rows.PrintEach("adaptive QAG (GSL)", std::string("tolerance ") + name,
                   [&](std::size_t i) { return nested.Integrate(table[i], tolerance); });
  }
  MonteCarlo(table, rows);
  return EXIT_SUCCESS;
}
