// SPDX-License-Identifier: Apache-2.0
#include "picture_file.h"

#include <cairo-pdf.h>
#include <cairo.h>
#include <dlfcn.h>
#include <librsvg/rsvg.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

#include "clock.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/png.h"
#include "lightcal/report/raster_style.h"
#include "raster_png.h"

namespace lightcal::app {
namespace {

constexpr double kScale = 2.0;
constexpr double kLargestSide = 8192.0;
constexpr const char* kLibrary = "librsvg-2.so.2";

// The few functions of librsvg, cairo and GLib that are used, found when first needed.
struct Rasterizer {
  decltype(&rsvg_handle_new_from_data) handle_new;
  decltype(&rsvg_handle_get_intrinsic_dimensions) dimensions;
  decltype(&rsvg_handle_render_document) render;
  decltype(&cairo_image_surface_create) surface_create;
  decltype(&cairo_surface_destroy) surface_destroy;
  decltype(&cairo_create) context_create;
  decltype(&cairo_destroy) context_destroy;
  decltype(&cairo_set_source_rgb) set_color;
  decltype(&cairo_paint) paint;
  decltype(&cairo_surface_write_to_png_stream) write_png;
  decltype(&cairo_pdf_surface_create_for_stream) pdf_create;
  decltype(&cairo_pdf_surface_set_metadata) pdf_say;
  decltype(&cairo_surface_finish) surface_finish;
  decltype(&g_object_unref) unref;
};

tl::unexpected<Error> NoRasterizer() {
  return Failed("no_rasterizer", "PNG",
                "is painted by librsvg, which does not load; install it (Debian: apt install "
                "librsvg2-2), or write an .svg");
}

// dlsym also looks into the libraries that librsvg needs.
template <class Function>
bool Find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}

// Never closed: GLib's types stay registered until the end.
Result<Rasterizer> OpenRasterizer() {
  void* const library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return NoRasterizer();
  Rasterizer r{};
  const bool complete = Find(library, "rsvg_handle_new_from_data", r.handle_new) &&
                        Find(library, "rsvg_handle_get_intrinsic_dimensions", r.dimensions) &&
                        Find(library, "rsvg_handle_render_document", r.render) &&
                        Find(library, "cairo_image_surface_create", r.surface_create) &&
                        Find(library, "cairo_surface_destroy", r.surface_destroy) &&
                        Find(library, "cairo_create", r.context_create) &&
                        Find(library, "cairo_destroy", r.context_destroy) &&
                        Find(library, "cairo_set_source_rgb", r.set_color) &&
                        Find(library, "cairo_paint", r.paint) &&
                        Find(library, "cairo_surface_write_to_png_stream", r.write_png) &&
                        Find(library, "cairo_pdf_surface_create_for_stream", r.pdf_create) &&
                        Find(library, "cairo_pdf_surface_set_metadata", r.pdf_say) &&
                        Find(library, "cairo_surface_finish", r.surface_finish) &&
                        Find(library, "g_object_unref", r.unref);
  return complete ? Result<Rasterizer>(r) : NoRasterizer();
}

cairo_status_t Append(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

Result<std::string> Printed(const Rasterizer& r, const std::string& svg, double width_mm,
                            double height_mm) {
  const auto bad = [] { return Failed("bad_drawing", "PDF", "librsvg cannot print the page"); };
  constexpr double kPointsPerMillimetre = 72.0 / 25.4;
  const RsvgRectangle page = {0.0, 0.0, kPointsPerMillimetre * width_mm,
                              kPointsPerMillimetre * height_mm};
  const auto* bytes = reinterpret_cast<const guint8*>(svg.data());
  const std::unique_ptr<RsvgHandle, decltype(r.unref)> handle(
      r.handle_new(bytes, svg.size(), nullptr), r.unref);
  if (!handle) return bad();
  std::string pdf;
  const std::unique_ptr<cairo_surface_t, decltype(r.surface_destroy)> surface(
      r.pdf_create(Append, &pdf, page.width, page.height), r.surface_destroy);
  r.pdf_say(surface.get(), CAIRO_PDF_METADATA_CREATOR, GeneratorName().c_str());
  r.pdf_say(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
            SourceDateIso8601().value_or("2000-01-01T00:00:00Z").c_str());
  {
    const std::unique_ptr<cairo_t, decltype(r.context_destroy)> context(
        r.context_create(surface.get()), r.context_destroy);
    if (r.render(handle.get(), context.get(), &page, nullptr) == FALSE) return bad();
  }
  r.surface_finish(surface.get());
  return pdf;
}

Result<std::string> Painted(const Rasterizer& r, const std::string& svg) {
  const auto bad = [] { return Failed("bad_drawing", "PNG", "librsvg cannot paint the drawing"); };
  const auto* bytes = reinterpret_cast<const guint8*>(svg.data());
  const std::unique_ptr<RsvgHandle, decltype(r.unref)> handle(
      r.handle_new(bytes, svg.size(), nullptr), r.unref);
  if (!handle) return bad();
  gboolean has_box = FALSE;
  RsvgRectangle box{};
  r.dimensions(handle.get(), nullptr, nullptr, nullptr, nullptr, &has_box, &box);
  const RsvgRectangle page = {0.0, 0.0, std::ceil(kScale * box.width),
                              std::ceil(kScale * box.height)};
  const bool fits = page.width >= 1.0 && page.height >= 1.0 && page.width <= kLargestSide &&
                    page.height <= kLargestSide;
  if (has_box == FALSE || !fits) return bad();
  const std::unique_ptr<cairo_surface_t, decltype(r.surface_destroy)> surface(
      r.surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(page.width),
                       static_cast<int>(page.height)),
      r.surface_destroy);
  const std::unique_ptr<cairo_t, decltype(r.context_destroy)> context(
      r.context_create(surface.get()), r.context_destroy);
  r.set_color(context.get(), 1.0, 1.0, 1.0);
  r.paint(context.get());
  if (r.render(handle.get(), context.get(), &page, nullptr) == FALSE) return bad();
  std::string png;
  if (r.write_png(surface.get(), Append, &png) != CAIRO_STATUS_SUCCESS) return bad();
  return png;
}

// A PNG chunk of text behind the header chunk.  Source: ISO/IEC 15948:2004, 5.3 and 11.3.4.3.
void AddProvenance(std::string& png) {
  constexpr std::size_t kSignatureAndHeader = 8 + 25;
  if (png.size() < kSignatureAndHeader) return;
  png.insert(kSignatureAndHeader,
             PngChunk("tEXt", "Software" + std::string(1, '\0') + GeneratorName()));
}

bool IsPng(const std::string& path) { return LowerAscii(path).ends_with(".png"); }

}  // namespace

Result<void> CheckPictureName(const std::string& option, const std::string& path) {
  if (IsPng(path) || LowerAscii(path).ends_with(".svg")) return {};
  return WrongUsage(option, "\"" + path + "\" must end in .svg or .png");
}

Result<OutputFile> PrintFile(const std::string& path, const std::string& svg, double width_mm,
                             double height_mm) {
  const std::string lower = LowerAscii(path);
  if (lower.ends_with(".svg")) return OutputFile{path, svg};
  if (!lower.ends_with(".pdf")) {
    return WrongUsage("--board", "\"" + path + "\" must end in .pdf or .svg");
  }
  const auto rasterizer = OpenRasterizer();
  if (!rasterizer) return tl::unexpected(rasterizer.error());
  auto pdf = Printed(*rasterizer, svg, width_mm, height_mm);
  if (!pdf) return Propagate(std::move(pdf));
  return OutputFile{path, *std::move(pdf)};
}

Result<OutputFile> PictureFile(const std::string& path, const std::string& svg) {
  if (!IsPng(path)) return OutputFile{path, svg};
  static const Result<Rasterizer> rasterizer = OpenRasterizer();
  if (!rasterizer) return tl::unexpected(rasterizer.error());
  auto png = Painted(*rasterizer, report::ForRaster(svg));
  if (!png) return Propagate(std::move(png));
  AddProvenance(*png);
  return OutputFile{path, *std::move(png)};
}

}  // namespace lightcal::app
