#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "isolux/photometry/quantities.h"
#include "isolux/photometry/read_photometry.h"
#include "isolux/photometry/write_ies.h"
#include "isolux/photometry/write_ldt.h"

/// What must hold for any bytes whatever: a file is refused with a place, or it is light that
/// can be evaluated, integrated, written and read again.
namespace isolux::fuzz {

inline void insist(bool condition) {
    if (!condition)
        std::abort();
}

inline void check_refusal(const InputError& error, std::string_view name) {
    insist(!error.messages().empty());
    if (!std::string_view(error.what()).starts_with(name))
        std::fprintf(stderr, "%s\n", error.what());
    for (const Message& m : error.messages()) {
        insist(m.where.starts_with(name) && m.where.size() > name.size() + 1);
        insist(!m.what.empty());
    }
}

inline void check_light(const LuminairePhotometry& l) {
    const double flux = l.distribution.flux().value();
    insist(flux >= 0.0 && !std::isnan(flux));
    insist(!(l.distribution.flux_trapezoid().value() < 0.0));
    for (const Vector3& v : {Vector3{0, 0, -1},
                             Vector3{0, 0, 1},
                             Vector3{1, 0, 0},
                             Vector3{0, -1, 0},
                             Vector3{-3, 2, 1},
                             Vector3{1e-9, 1e-12, -1}}) {
        const double i = l.distribution.evaluate(UnitVector3(v)).value();
        insist(i >= 0.0 && i <= l.distribution.max_intensity().value() * (1 + 1e-12));
    }
    for (const Metre size : {l.opening.extent_x, l.opening.extent_y, l.opening.extent_z})
        insist(size.value() >= 0.0 && std::isfinite(size.value()));
}

/// Numbers within what a luminaire can be come back as they were written. Writing and reading
/// again takes many times what reading takes, most where a table lies on its side and is
/// resampled: every 16th size must do, every 64th of the latter, tables of at most 400 values.
inline void check_round_trip(const LuminairePhotometry& l, std::size_t file_size) {
    if (file_size % (l.distribution.pole() == TablePole::lateral ? 64 : 16) != 0)
        return;
    const double largest = l.distribution.max_intensity().value();
    const std::size_t nodes = l.distribution.planes().size() * l.distribution.gammas().size();
    if (!(largest > 1e-3 && largest < 1e9) || nodes > 400)
        return;
    const auto back = parse_photometry(write_ies(l).value, "back.ies").value;
    const UnitVector3 nadir = UnitVector3::from_unit({0, 0, -1});
    insist(std::abs(back.distribution.evaluate(nadir).value()
                    - l.distribution.evaluate(nadir).value())
           <= 1e-5 * largest);
    const LampSet* const set = l.lamp_sets.empty() ? nullptr : &l.lamp_sets[l.lamp_set];
    const bool has_usual_flux =
        set == nullptr || (set->flux.value() > 1e-3 && set->flux.value() < 1e9);
    if (l.distribution.pole() == TablePole::nadir && has_usual_flux)
        static_cast<void>(parse_photometry(write_ldt(l).value, "back.ldt"));
}

inline void run(const std::uint8_t* data, std::size_t size, std::string_view name) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    PhotometryOptions options;
    options.sibling = [](std::string_view) {
        return std::optional<std::string>("1 2 0 90 1 .9");
    };
    try {
        const auto parsed = parse_photometry(bytes, name, options);
        check_light(parsed.value);
        check_round_trip(parsed.value, size);
    } catch (const InputError& error) {
        check_refusal(error, name);
    }
}

} // namespace isolux::fuzz
