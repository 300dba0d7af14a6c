// Rendered pictures against closed answers: METHODS 7.2 row 20 (the furnace through mirrors and
// panes), a wall, a luminaire, and the same bits for any number of threads (row 25).

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stop_token>
#include <string_view>

#include <gtest/gtest.h>

#include "isolux/base/parallel.h"
#include "isolux/calc/luminance.h"
#include "isolux/calc/render.h"
#include "isolux/calc/view_bands.h"

#include "support/statistics.h"
#include "support/test_scene.h"

namespace isolux {
namespace {

using test::Builder;

constexpr double pi = std::numbers::pi;

View view_of(const Point3& position,
             const Point3& target,
             double field_of_view,
             std::size_t columns,
             std::size_t rows) {
    View v;
    v.name = "test";
    v.camera.position = position;
    v.camera.target = target;
    v.camera.field_of_view = degrees(field_of_view);
    v.camera.columns = columns;
    v.camera.rows = rows;
    return v;
}

RenderSettings settings_of(std::size_t samples, PictureFilter filter, std::uint64_t seed = 1) {
    RenderSettings s;
    s.samples = samples;
    s.filter = filter;
    s.seed = seed;
    return s;
}

/// All walls emit M and reflect rho; a mirror and a pane that lose nothing stand in it.
Scene furnace(double exitance, double rho) {
    Builder b;
    const Point3 p{0, 0, 0};
    const Vector3 x{3, 0, 0};
    const Vector3 y{0, 2.5, 0};
    const Vector3 z{0, 0, 2};
    const auto m = b.add_diffuse(rho);
    b.add_room(p, {3, 2.5, 2}, m, m, m);
    b.add_panel(p, x, y, exitance * 7.5);
    b.add_panel(p + z, y, x, exitance * 7.5);
    b.add_panel(p, y, z, exitance * 5.0);
    b.add_panel(p + x, z, y, exitance * 5.0);
    b.add_panel(p, z, x, exitance * 6.0);
    b.add_panel(p + y, x, z, exitance * 6.0);
    const auto mirror = b.add_material({"mirror", Opaque{Rgb::grey(0.0), 1.0}, Sides::both});
    const auto glass = b.add_material({"glass", ClearPane{1.52, 1.0}, Sides::both});
    b.add_quad({1.0, 0.6, 0.4}, {0, 1.2, 0}, {0, 0, 1.2}, mirror);
    b.add_quad({2.0, 0.5, 0.3}, {0, 1.4, 0.2}, {0, 0, 1.3}, glass);
    return b.build();
}

double mean_of(const ViewPicture& p) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size.pixels(); ++i)
        sum += luminance_sum(p.raw.colour(i)) / static_cast<double>(p.size.pixels());
    return sum;
}

TEST(RenderedFurnace, IsOneLuminanceThroughMirrorsAndPanes) {
    const Scene scene = furnace(100.0, 0.6);
    const double exact = 100.0 / (pi * 0.4);
    const View view = view_of({2.6, 0.4, 1.0}, {0.8, 1.6, 0.9}, 80.0, 12, 8);
    const Estimate e = test::over_seeds([&](std::size_t s) {
        return mean_of(render(scene, view, settings_of(2, PictureFilter::none, s + 1)));
    });
    EXPECT_LT(std::abs(test::z_score(e, exact)), test::z_limit)
        << e.mean << " +- " << e.standard_error << ", exact " << exact;
    EXPECT_LT(e.standard_error, 0.005 * exact);
}

TEST(RenderedWall, HasIlluminanceTimesReflectanceOverPi) {
    Builder b;
    b.add_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, b.add_diffuse(0.4));
    b.add_point({0.2, 0.1, 1.5}, b.add_isotropic_type(4.0 * pi * 100.0)); // 100 cd
    const Scene scene = b.build();
    // a narrow view straight down: within a pixel the illuminance hardly changes
    View view = view_of({0, 0, 1}, {0, 0, 0}, 40.0, 41, 41);
    const ViewPicture p = render(scene, view, settings_of(4, PictureFilter::none));
    const CameraRays rays(view.camera);
    for (const std::size_t i : {20u * 41u + 20u, 3u * 41u + 30u, 40u * 41u + 2u}) {
        const auto line = rays.sight_line(i % 41 + 0.5, i / 41 + 0.5);
        const Point3 at =
            line->eye - (line->eye.z / line->direction.z()) * Vector3(line->direction);
        const Vector3 d = Point3{0.2, 0.1, 1.5} - at;
        const double exact = 100.0 * d.z / std::pow(length(d), 3) * 0.4 / pi;
        EXPECT_NEAR(luminance_sum(p.raw.colour(i)), exact, 2e-3 * exact) << i;
        EXPECT_NEAR(p.albedo.y[i], 0.4, 1e-6);
        EXPECT_NEAR(p.normal.z[i], 1.0, 1e-6);
        EXPECT_NEAR(p.position.x[i], at.x, 0.02);
        EXPECT_EQ(p.object[i], 1u);
        EXPECT_NEAR(p.illuminance[i], exact * pi / 0.4, 2e-3 * exact * pi / 0.4);
    }
}

TEST(RenderedLuminaire, HasTheLuminanceOfItsOpening) {
    Builder b;
    b.add_panel({-1, -1, 2}, {0, 2, 0}, {2, 0, 0}, 4.0 * pi * 70.0);
    const Scene scene = b.build();
    const ViewPicture p = render(scene,
                                 view_of({0, 0, 0}, {0, 0, 2}, 30.0, 8, 8),
                                 settings_of(2, PictureFilter::axis_aligned));
    for (std::size_t i = 0; i < p.size.pixels(); ++i) {
        EXPECT_NEAR(p.luminance(i), 70.0, 1e-4);
        EXPECT_EQ(p.object[i], 0u);
        EXPECT_EQ(p.standard_error[i], 0.0F);
    }
}

/// A furnished corner: a shadow, a mirror, a pane.
Scene corner() {
    Builder b;
    const auto walls = b.add_material({"paint", Opaque{{0.6, 0.5, 0.4}}, Sides::both});
    b.add_room({0, 0, 0}, {3, 3, 2.5}, walls, walls, walls);
    b.add_quad({1.2, 1.2, 0.7}, {0.8, 0, 0}, {0, 0.6, 0}, b.add_diffuse(0.3));
    b.add_quad({2.2, 0.5, 0.2},
               {0, 2, 0},
               {0, 0, 2},
               b.add_material({"glass", ClearPane{}, Sides::both}));
    b.add_quad({0.01, 0.8, 0.5},
               {0, 1, 0},
               {0, 0, 1},
               b.add_material({"mirror", Opaque{Rgb::grey(0.0), 0.9}, Sides::both}));
    b.add_panel({1.2, 1.2, 2.4}, {0, 0.6, 0}, {0.6, 0, 0}, 2000.0);
    b.add_point({2.6, 0.4, 2.0}, b.add_isotropic_type(300.0));
    return b.build();
}

/// Mean luminance of a view by sight lines through its pixels, per_side² in each, cd/m2.
double mean_along_sight_lines(const Scene& scene,
                              const View& view,
                              int per_side,
                              const Settings& settings) {
    std::vector<SightLine> lines;
    const CameraRays rays(view.camera);
    for (std::size_t row = 0; row < view.camera.rows; ++row)
        for (std::size_t column = 0; column < view.camera.columns; ++column)
            for (int k = 0; k < per_side * per_side; ++k)
                lines.push_back(*rays.sight_line(
                    static_cast<double>(column) + (k % per_side + 0.5) / per_side,
                    static_cast<double>(row) + (k / per_side + 0.5) / per_side));
    double mean = 0.0;
    for (const LuminanceResult& r : estimate_luminances(scene, lines, settings).rays)
        mean += r.total.mean / static_cast<double>(lines.size());
    return mean;
}

TEST(RenderedPicture, AgreesWithTheLuminanceOfItsSightLines) {
    const Scene scene = corner();
    const View view = view_of({0.6, 0.4, 1.6}, {1.6, 1.8, 0.8}, 60.0, 6, 4);
    Settings settings;
    settings.fixed_units = 1;
    const double mean = mean_along_sight_lines(scene, view, 4, settings);
    const Estimate e = test::over_seeds([&](std::size_t s) {
        return mean_of(render(scene, view, settings_of(4, PictureFilter::none, s + 1)));
    });
    // 16 midpoints a pixel stand for its area: what lies on edges is worth half a percent.
    EXPECT_NEAR(e.mean, mean, test::z_limit * e.standard_error + 5e-3 * mean);
    EXPECT_LT(e.standard_error, 0.01 * mean);
}

TEST(RenderedPicture, SharesALayerAmongManyLuminaires) {
    // More luminaires than layers, and pixels as large as the box: most show two surfaces.
    Builder b;
    b.add_quad({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, b.add_diffuse(0.4));
    b.add_quad({-0.4, -0.3, 0.5}, {0.8, 0, 0}, {0, 0.6, 0}, b.add_diffuse(0.2));
    const auto type = b.add_isotropic_type(500.0);
    for (int i = 0; i < 20; ++i)
        b.add_point({-1.5 + i % 5 * 0.75, -1.5 + i / 5 * 0.9, 2.0 + 0.05 * i}, type);
    const Scene scene = b.build();
    const View view = view_of({1.5, -1.2, 1.8}, {0, 0, 0.3}, 40.0, 7, 5);
    RenderSettings settings = settings_of(64, PictureFilter::none);
    settings.direct_only = true;
    Settings exact_settings;
    exact_settings.fixed_units = 1;
    exact_settings.direct_only = true;
    const double exact = mean_along_sight_lines(scene, view, 16, exact_settings);
    const Estimate e = test::over_seeds([&](std::size_t s) {
        settings.seed = s + 1;
        return mean_of(render(scene, view, settings));
    });
    EXPECT_NEAR(e.mean, exact, test::z_limit * e.standard_error + 5e-3 * exact);
    EXPECT_LT(e.standard_error, 0.005 * exact);
}

TEST(RenderedPicture, IsTheSumOfItsParts) {
    const ViewPicture p = render(corner(),
                                 view_of({0.6, 0.4, 1.6}, {1.6, 1.8, 0.8}, 60.0, 24, 16),
                                 settings_of(4, PictureFilter::none));
    for (std::size_t i = 0; i < p.size.pixels(); ++i) {
        const Rgb parts = p.emission.colour(i) + p.direct.colour(i) + p.indirect.colour(i);
        EXPECT_NEAR(luminance_sum(parts),
                    luminance_sum(p.raw.colour(i)),
                    1e-4 * luminance_sum(p.raw.colour(i)) + 1e-6);
        EXPECT_EQ(p.samples[i], 4.0F);
    }
    EXPECT_GT(p.error, 0.0);
    EXPECT_TRUE(p.filtered.x.empty());
}

TEST(RenderedPicture, HasTheSameBitsForAnyNumberOfThreads) {
    const Scene scene = corner();
    View view = view_of({0.6, 0.4, 1.6}, {1.6, 1.8, 0.8}, 60.0, 40, 24);
    view.camera.lens_radius = 0.02;
    for (const std::size_t samples : {4, 16}) { // even and uneven counts
        for (const bool is_preview : {false, true}) {
            const auto with = [&](std::size_t threads) {
                const ThreadLimit limit(threads);
                RenderSettings settings = settings_of(samples, PictureFilter::axis_aligned);
                settings.is_preview = is_preview;
                return render(scene, view, settings);
            };
            const ViewPicture one = with(1);
            ASSERT_FALSE(one.filtered.x.empty());
            for (const std::size_t threads : {2, 7}) {
                const ViewPicture other = with(threads);
                EXPECT_EQ(one.raw.x, other.raw.x);
                EXPECT_EQ(one.raw.z, other.raw.z);
                EXPECT_EQ(one.filtered.y, other.filtered.y);
                EXPECT_EQ(one.standard_error, other.standard_error);
                EXPECT_EQ(one.filter_width, other.filter_width);
                EXPECT_EQ(one.depth, other.depth);
                EXPECT_EQ(one.samples, other.samples);
            }
        }
    }
}

/// In bands of rows, a picture is what it is in one piece.
TEST(RenderedPicture, HasTheSameBitsInBands) {
    const Scene scene = corner();
    const View view = view_of({0.6, 0.4, 1.6}, {1.6, 1.8, 0.8}, 60.0, 12, 400);
    for (const PictureFilter filter : {PictureFilter::none, PictureFilter::axis_aligned}) {
        RenderSettings settings = settings_of(4, filter);
        const ViewPicture whole = render(scene, view, settings);
        settings.pixels_at_once = 1000;
        ASSERT_EQ(bands_of(view.camera, settings).size(), 3U);
        const ViewPicture joined = render(scene, view, settings);
        EXPECT_EQ(whole.raw.y, joined.raw.y);
        EXPECT_EQ(whole.standard_error, joined.standard_error);
        // What lies beyond a band's margin has chosen widths of pixels the filter reads.
        ASSERT_EQ(whole.filtered.y.size(), joined.filtered.y.size());
        for (std::size_t i = 0; i < whole.filtered.y.size(); ++i) {
            ASSERT_NEAR(whole.filtered.y[i], joined.filtered.y[i], 5e-4 * whole.filtered.y[i])
                << i;
            ASSERT_NEAR(whole.filtered_error[i], joined.filtered_error[i], 1e-3) << i;
        }
        EXPECT_EQ(whole.position.z, joined.position.z);
        EXPECT_EQ(whole.object, joined.object);
        EXPECT_EQ(whole.samples, joined.samples);
        EXPECT_NEAR(whole.error, joined.error, 1e-5 * whole.error);
        EXPECT_EQ(whole.object_names, joined.object_names);
    }
}

/// Whoever stops while the first band is filtered is told that the others are missing.
TEST(RenderedPicture, SaysThatBandsAreMissing) {
    const Scene scene = corner();
    const View view = view_of({0.6, 0.4, 1.6}, {1.6, 1.8, 0.8}, 60.0, 12, 400);
    RenderSettings settings = settings_of(4, PictureFilter::axis_aligned);
    settings.pixels_at_once = 1000;
    std::stop_source stop;
    Control control;
    control.stop = stop.get_token();
    control.progress = [&](const Progress& p) {
        if (std::string_view(p.stage) == "filtering")
            stop.request_stop();
    };
    EXPECT_TRUE(render(scene, view, settings, control).interrupted);
    EXPECT_TRUE(stop.stop_requested());
}

TEST(PictureBands, CoverAllRowsOnceAndLookBeyond) {
    Camera camera;
    camera.columns = 4096;
    camera.rows = 4096;
    const auto bands = bands_of(camera, settings_of(4, PictureFilter::axis_aligned));
    std::size_t next = 0;
    for (const PictureBand& b : bands) {
        EXPECT_EQ(b.kept.first, next);
        next += b.kept.count;
        EXPECT_EQ(b.rendered.first % 16, 0U);
        EXPECT_EQ(b.rendered.first, b.kept.first - std::min<std::size_t>(b.kept.first, 96));
        EXPECT_EQ(b.rendered.first + b.rendered.count, std::min<std::size_t>(4096, next + 96));
        EXPECT_LE(b.rendered.count * 4096, 4'200'000U);
    }
    EXPECT_EQ(next, 4096U);
    EXPECT_GT(bands.size(), 1U);
    camera.lens_radius = 0.01;
    EXPECT_EQ(bands_of(camera, settings_of(4, PictureFilter::axis_aligned)).size(), 1U);
    EXPECT_GT(bands_of(camera, settings_of(4, PictureFilter::none)).size(), 1U);
    EXPECT_EQ(bands_of(camera, settings_of(4, PictureFilter::oidn)).size(), 1U);
}

TEST(RenderedPreview, TakesAsManySamplesAsAskedInEveryPixel) {
    const View view = view_of({0.6, 0.4, 1.6}, {1.6, 1.8, 0.8}, 60.0, 37, 19);
    for (const std::size_t samples : {2, 3, 9}) {
        RenderSettings settings = settings_of(samples, PictureFilter::axis_aligned);
        settings.is_preview = true;
        const ViewPicture p = render(corner(), view, settings);
        EXPECT_FALSE(p.interrupted);
        for (const float n : p.samples)
            ASSERT_EQ(n, static_cast<float>(samples));
    }
}

TEST(UnevenSamples, GoWhereThePilotSawNoiseAndKeepToTheirMean) {
    const View view = view_of({0.6, 0.4, 1.6}, {1.6, 1.8, 0.8}, 60.0, 64, 40);
    const ViewPicture p = render(corner(), view, settings_of(16, PictureFilter::axis_aligned));
    double mean = 0.0;
    for (const float s : p.samples) {
        EXPECT_EQ(std::fmod(s, 4.0F), 0.0F) << "every replicate as often";
        EXPECT_GE(s, 8.0F);
        EXPECT_LE(s, 32.0F);
        mean += static_cast<double>(s) / static_cast<double>(p.size.pixels());
    }
    EXPECT_GT(mean, 14.0);
    EXPECT_LE(mean, 16.0);
    EXPECT_NE(*std::min_element(p.samples.begin(), p.samples.end()),
              *std::max_element(p.samples.begin(), p.samples.end()));
}

TEST(UnevenSamples, BiasNoPictureAndKeepItsErrorsHonest) {
    const Scene scene = corner();
    const View view = view_of({0.6, 0.4, 1.6}, {1.6, 1.8, 0.8}, 15.0, 16, 10);
    const ViewPicture fine = render(scene, view, settings_of(1024, PictureFilter::none, 99));
    double truth = 0.0;
    for (std::size_t i = 0; i < fine.size.pixels(); ++i)
        truth += luminance_sum(fine.raw.colour(i)) / static_cast<double>(fine.size.pixels());
    double squares = 0.0;
    double promised = 0.0;
    const Estimate e = test::over_seeds([&](std::size_t s) {
        const ViewPicture p =
            render(scene, view, settings_of(16, PictureFilter::axis_aligned, s + 1));
        for (std::size_t i = 0; i < p.size.pixels(); ++i) {
            squares +=
                std::pow(luminance_sum(p.raw.colour(i)) - luminance_sum(fine.raw.colour(i)), 2);
            promised += std::pow(p.standard_error[i], 2);
        }
        return mean_of(p);
    });
    EXPECT_NEAR(e.mean, truth, test::z_limit * e.standard_error + 0.002 * truth);
    EXPECT_LT(e.standard_error, 0.01 * truth);
    EXPECT_NEAR(squares / promised, 1.0, 0.15);
}

TEST(RenderedPreview, IsAsBrightAsThePicture) {
    const Scene scene = corner();
    const View view = view_of({0.6, 0.4, 1.6}, {1.6, 1.8, 0.8}, 60.0, 40, 24);
    const double truth =
        mean_of(render(scene, view, settings_of(128, PictureFilter::none, 99)));
    for (const std::size_t samples : {2, 8}) {
        const Estimate e = test::over_seeds([&](std::size_t s) {
            RenderSettings settings = settings_of(samples, PictureFilter::axis_aligned, s + 1);
            settings.is_preview = true;
            return mean_of(render(scene, view, settings));
        });
        // Openings are points beyond twice their size, which is worth a percent.
        EXPECT_NEAR(e.mean, truth, test::z_limit * e.standard_error + 0.015 * truth);
        EXPECT_LT(e.standard_error, 0.005 * truth);
    }
}

TEST(UnevenSamples, MeetATolerance) {
    const View view = view_of({0.6, 0.4, 1.6}, {1.6, 1.8, 0.8}, 60.0, 24, 16);
    RenderSettings s = settings_of(4096, PictureFilter::axis_aligned);
    s.tolerance = 0.3;
    const ViewPicture p = render(corner(), view, s);
    EXPECT_LE(p.error, 0.3);
    EXPECT_FALSE(p.interrupted);
    EXPECT_LT(*std::max_element(p.samples.begin(), p.samples.end()), 4096.0F);
}

TEST(RenderedPicture, StopsAtItsToleranceOrWhenAsked) {
    const Scene scene = corner();
    const View view = view_of({0.6, 0.4, 1.6}, {1.6, 1.8, 0.8}, 60.0, 24, 16);
    RenderSettings s = settings_of(4096, PictureFilter::none);
    s.tolerance = 0.5;
    const ViewPicture rough = render(scene, view, s);
    EXPECT_LE(rough.error, 0.5);
    EXPECT_LT(rough.samples[0], 4096.0F);
    EXPECT_FALSE(rough.interrupted);

    std::stop_source stop;
    stop.request_stop();
    const ViewPicture none =
        render(scene, view, settings_of(4, PictureFilter::none), {stop.get_token(), {}});
    EXPECT_TRUE(none.interrupted);
    EXPECT_EQ(none.samples[0], 0.0F);
    EXPECT_EQ(none.raw.x[0], 0.0F);
}

TEST(RenderedPicture, FilteredIsLessNoisyAndNoBrighter) {
    const Scene scene = corner();
    const View view = view_of({0.6, 0.4, 1.6}, {1.6, 1.8, 0.8}, 60.0, 64, 40);
    const ViewPicture fine = render(scene, view, settings_of(256, PictureFilter::none, 5));
    const ViewPicture p = render(scene, view, settings_of(8, PictureFilter::axis_aligned));
    double raw = 0.0;
    double filtered = 0.0;
    double mean = 0.0;
    double shown = 0.0;
    for (std::size_t i = 0; i < p.size.pixels(); ++i) {
        const double truth = luminance_sum(fine.raw.colour(i));
        raw += std::pow(luminance_sum(p.raw.colour(i)) - truth, 2);
        filtered += std::pow(p.luminance(i) - truth, 2);
        mean += truth;
        shown += p.luminance(i);
    }
    EXPECT_LT(filtered, 0.5 * raw);
    EXPECT_NEAR(shown / mean, 1.0, 0.02);
}

} // namespace
} // namespace isolux
