// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/usd_prims.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units.h"
#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/check/whole_text.h"

namespace lightcal {
namespace {

std::string_view BetweenQuotes(std::string_view line) {
  const std::size_t quote = std::min(line.find('"'), line.size());
  const std::size_t close = std::min(line.find('"', quote + 1), line.size());
  return quote < close ? line.substr(quote + 1, close - quote - 1) : std::string_view();
}

// The variant sets of a file, line by line: which lines are of a variant that is not chosen.
class Variants {
 public:
  // Of a line that is another variant's, or begins or ends one.
  bool Takes(std::string_view line, const std::string& chosen) {
    const int before = depth_;
    if (line.ends_with("{")) ++depth_;
    if (line == "}") --depth_;
    if (line.starts_with("variantSet ")) {
      set_ = before;
      return true;
    }
    if (set_ < 0) return false;
    if (depth_ <= set_) set_ = -1;  // the set's own brace
    if (before == set_ + 1 && line.starts_with('"')) {
      other_ = BetweenQuotes(line) != chosen;
      return true;
    }
    return set_ < 0 || other_;
  }

 private:
  int depth_ = 0, set_ = -1;
  bool other_ = false;
};

// Which prim a line is of, by the braces.
class OpenPrims {
 public:
  // A line of the text; a brace ends what it opened.
  void Take(std::string_view line) {
    if (line.starts_with(")")) --metadata_;
    if (line == "}") {
      --depth_;
      while (metadata_ == 0 && !open_.empty() && open_.back().depth >= depth_) open_.pop_back();
    }
    if (line.ends_with("(")) ++metadata_;
    before_ = depth_;
    if (line.ends_with("{")) ++depth_;
  }
  void Open(std::size_t prim) {
    while (!open_.empty() && open_.back().depth >= before_) open_.pop_back();
    if (open_.size() > kDeepestNode) throw std::runtime_error("its prims hang too deep");
    open_.push_back({prim, before_});
  }
  [[nodiscard]] std::size_t Current() const { return open_.empty() ? 0 : open_.back().prim; }
  // That one which begins here would hang below.
  [[nodiscard]] std::size_t Above() const {
    for (auto it = open_.rbegin(); it != open_.rend(); ++it) {
      if (it->depth < before_) return it->prim;
    }
    return 0;
  }

 private:
  struct Of {
    std::size_t prim = 0;
    int depth = 0;  // braces about it
  };
  std::vector<Of> open_;
  int depth_ = 0, before_ = 0;
  int metadata_ = 0;  // parentheses about it, whose dictionaries end no prim
};

Vec3 ThreeOf(const UsdPrim& prim, const std::string& op, const std::vector<double>& numbers) {
  if (numbers.size() != 3)
    throw std::runtime_error(prim.name + ": " + op + " has not three numbers");
  return {numbers[0], numbers[1], numbers[2]};
}

SceneFrame TurnedAbout(std::size_t axis, double degrees) {
  const double half = degrees * kRadiansPerDegree / 2.0;
  Vec3 about{};
  about[axis] = std::sin(half);
  return FrameTurnedBy(about, std::cos(half));
}

// One "xformOp:rotateXYZ": turned about x first, by its name.
SceneFrame Op(const UsdPrim& prim, const std::string& op) {
  const std::vector<double> numbers = NumbersIn(prim.Text(op));
  const std::string kind = op.substr(8, op.find(':', 8) - std::min<std::size_t>(op.size(), 8));
  SceneFrame frame;
  if (kind == "transform") {
    if (numbers.size() != 16) {
      throw std::runtime_error(prim.name + ": a matrix without sixteen numbers");
    }
    const auto row = [&](std::size_t at) {
      return Vec3{numbers[at], numbers[at + 1], numbers[at + 2]};
    };
    return {row(0), row(4), row(8), row(12)};
  }
  if (kind == "translate") {
    frame.origin = ThreeOf(prim, op, numbers);
  } else if (kind == "scale") {
    const Vec3 scale = ThreeOf(prim, op, numbers);
    frame = {frame.x * scale[0], frame.y * scale[1], frame.z * scale[2], {}};
  } else if (kind == "orient") {  // the real part first
    if (numbers.size() != 4) throw std::runtime_error(prim.name + ": orient has not four numbers");
    return FrameTurnedBy({numbers[1], numbers[2], numbers[3]}, numbers[0]);
  } else if (kind.starts_with("rotate")) {
    const std::string axes = kind.substr(6);
    const bool one = axes.size() == 1;
    if (numbers.size() != (one ? 1 : 3)) {
      throw std::runtime_error(prim.name + ": " + op + " has not its numbers");
    }
    for (const char letter : axes) {
      const auto axis = static_cast<std::size_t>(letter - 'X');
      if (axis > 2) throw std::runtime_error(prim.name + ": " + op + " is not known");
      frame = Within(TurnedAbout(axis, one ? numbers[0] : numbers[axis]), frame);
    }
  } else {
    throw std::runtime_error(prim.name + ": " + op + " is not known");
  }
  return frame;
}

// The names in `["xformOp:translate", "xformOp:scale"]`; without a list the matrix alone.
std::vector<std::string> OpsOf(const UsdPrim& prim) {
  const std::string& list = prim.Text("xformOpOrder");
  if (list.empty()) {
    if (prim.Text("xformOp:transform").empty()) return {};
    return {"xformOp:transform"};
  }
  std::vector<std::string> ops;
  for (std::size_t at = list.find('"'); at != std::string::npos; at = list.find('"', at + 1)) {
    const std::size_t close = list.find('"', at + 1);
    if (close == std::string::npos) break;
    ops.push_back(list.substr(at + 1, close - at - 1));
    at = close;
  }
  return ops;
}

}  // namespace

bool AreOversAlone(const std::vector<UsdPrim>& prims) {
  return std::ranges::all_of(prims, [](const UsdPrim& prim) { return prim.type.empty(); });
}

// `def Type "name"` begins a prim, which its brace ends. `over "name"` goes on with one that was
// there; a layer of nothing else is about prims of a person's stage.
std::vector<UsdPrim> UsdPrimsOf(const std::string& text) {
  if (!text.starts_with("#usda")) throw std::runtime_error("it does not begin with #usda");
  RequireClosed(text, kUsdaSyntax);
  std::vector<UsdPrim> prims(1);  // the layer's own metadata
  OpenPrims open;
  Variants variants;
  std::string chosen;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = TrimBlanks(std::string_view(text).substr(at, end - at));
    at = end + 1;
    open.Take(line);
    if (variants.Takes(line, chosen)) continue;
    if (line.starts_with("def ")) {
      const std::size_t quote = std::min(line.find('"'), line.size());
      UsdPrim prim;
      prim.type = TrimBlanks(line.substr(4, quote - std::min<std::size_t>(quote, 4)));
      prim.name = BetweenQuotes(line);
      prim.parent = open.Above();
      open.Open(prims.size());
      prims.push_back(std::move(prim));
      continue;
    }
    if (line.starts_with("over ")) {
      auto it = std::ranges::find(prims, BetweenQuotes(line), &UsdPrim::name);
      if (it == prims.end()) {
        if (!AreOversAlone(prims)) {
          throw std::runtime_error(std::string(line) + ": there is no such prim");
        }
        it = prims.insert(it, UsdPrim{.type = {}, .name = std::string(BetweenQuotes(line))});
      }
      open.Open(static_cast<std::size_t>(it - prims.begin()));
      continue;
    }
    const std::size_t equals = line.find(" = ");
    if (equals == std::string_view::npos) continue;
    const std::string_view left = line.substr(0, equals);
    const std::string_view value = TrimBlanks(line.substr(equals + 3));
    if (line.starts_with("string renderer = ")) chosen = BetweenQuotes(value);
    prims[open.Current()].values[std::string(left.substr(left.find_last_of(' ') + 1))] = value;
  }
  prims.front().values["renderer"] = chosen;
  return prims;
}

// The first of the order is the outermost.
PlacedPrim PlaceOfPrim(const std::vector<UsdPrim>& prims, const UsdPrim& prim) {
  PlacedPrim placed;
  if (prim.parent != 0) placed = PlaceOfPrim(prims, prims[prim.parent]);
  placed.hidden =
      placed.hidden || prim.Text("active") == "false" || prim.Text("visibility") == "\"invisible\"";
  for (const std::string& op : OpsOf(prim)) {
    if (op == "!resetXformStack!") {
      placed.frame = {};
    } else if (op.starts_with("xformOp:")) {
      placed.frame = Within(placed.frame, Op(prim, op));
    } else {
      throw std::runtime_error(prim.name + ": " + op + " is not known");
    }
  }
  return placed;
}

}  // namespace lightcal
