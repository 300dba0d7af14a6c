#include "isolux/calc/view_look.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isolux {

BlockRays::BlockRays(const ViewSetup& setup, std::size_t column, std::size_t row)
    : rays_a_pixel_(pilot_sight_lines(setup.settings)) {
    for (std::size_t k = 0; k < random_.size(); ++k) {
        const std::size_t x = column + k % 2;
        const std::size_t y = row + k / 2;
        if (x >= setup.size.columns || y >= setup.size.rows)
            continue;
        random_[k] = PointRandomness(setup.settings.seed,
                                     StreamPurpose::pilot,
                                     0,
                                     setup.number(y * setup.size.columns + x));
        for (std::size_t s = 0; s < rays_a_pixel_; ++s) {
            PilotRay& ray = rays_[k * rays_a_pixel_ + s];
            ray.numbers = NumberSequence(random_[k], static_cast<std::uint32_t>(s));
            ray.line = sight_line_of(setup, x, y, ray.numbers);
        }
    }
    cast(setup.scene.caster);
}

void BlockRays::cast(const RayCaster& caster) {
    static_assert(4 * most_pilot_samples <= packet_size);
    std::array<SightLine, packet_size> lines;
    std::array<std::optional<SurfaceHit>, packet_size> hits;
    std::size_t count = 0;
    for (const PilotRay& ray : rays_)
        if (ray.line)
            lines[count++] = *ray.line;
    caster.find_first_hits16(std::span(lines).first(count), hits);
    count = 0;
    for (PilotRay& ray : rays_)
        if (ray.line)
            ray.hit = hits[count++];
}

void PilotLook::look(std::span<const PilotRay> rays) {
    thread_local EyePath passing;
    for (std::size_t s = 0; s < rays.size(); ++s) {
        EyePath& path =
            keep_ != nullptr ? keep_->paths[keep_->index(column_, row_, s)] : passing;
        NumberSequence numbers = rays[s].numbers;
        ++asked_;
        if (!rays[s].line) {
            path.luminaires = {};
            path.surfaces.clear();
            continue;
        }
        follow_eye(
            setup_.scene, setup_.emission, *rays[s].line, numbers, path, rays_, &rays[s].hit);
        const SeenSurface* seen = primary_of(path);
        on_luminaire_ += luminance_sum(path.luminaires) > 0.0 ? 1U : 0U;
        has_more_ = has_more_ || path.surfaces.size() > (seen != nullptr ? 1U : 0U);
        if (seen == nullptr || used_ == samples_.size())
            continue;
        Sample& sample = samples_[used_++];
        sample.seen = *seen;
        sample.object = object_of(setup_.scene, *seen);
        sample.depth_on_axis = setup_.camera.depth_of(seen->at);
        sample.cluster = join(sample);
    }
    pick_two();
}

std::size_t PilotLook::join(const Sample& s) {
    for (std::size_t c = 0; c < clusters_used_; ++c)
        if (clusters_[c].object == s.object
            && dot(clusters_[c].first_normal, s.seen.normal) >= same_normal
            && is_level(s.seen.normal, s.seen.at - clusters_[c].first_place))
            return add(c, s);
    clusters_[clusters_used_] = {s.object, s.seen.normal, s.seen.at, 0, {}, {}, 0.0};
    return add(clusters_used_++, s);
}

std::size_t PilotLook::add(std::size_t c, const Sample& s) {
    Cluster& cluster = clusters_[c];
    ++cluster.count;
    cluster.normal = cluster.normal + Vector3(s.seen.normal);
    cluster.position = cluster.position + (s.seen.at - Point3{});
    cluster.depth += s.seen.travelled;
    return c;
}

void PilotLook::pick_two() {
    first_ = second_ = clusters_.size();
    for (std::size_t c = 0; c < clusters_used_; ++c)
        if (first_ >= clusters_used_ || clusters_[c].count > clusters_[first_].count)
            first_ = c;
    for (std::size_t c = 0; c < clusters_used_; ++c)
        if (c != first_
            && (second_ >= clusters_used_ || clusters_[c].count > clusters_[second_].count))
            second_ = c;
    for (std::size_t s = 0; s < used_; ++s)
        if (samples_[s].cluster == first_)
            on_first_[on_first_used_++] = samples_[s].seen;
}

SeenPlace PilotLook::place_of(std::size_t c) const noexcept {
    const Cluster& cluster = clusters_[c];
    return {Point3{} + cluster.position / static_cast<double>(cluster.count),
            UnitVector3(cluster.normal)};
}

/// Where the line of sight through a place of the picture meets the tangent plane.
std::optional<Point3>
PilotLook::on_plane(const SeenPlace& p, double x, double y) const noexcept {
    const auto line = setup_.camera.sight_line(x, y + static_cast<double>(setup_.first_row));
    if (!line)
        return std::nullopt;
    const double slope = dot(p.normal, line->direction);
    const double t = dot(p.normal, p.at - line->eye) / slope;
    if (!(slope < -1e-4) || !(t > 0.0))
        return std::nullopt;
    return line->eye + t * Vector3(line->direction);
}

SeenPlace PilotLook::first_place() const noexcept {
    SeenPlace p = place_of(first_);
    if (clusters_[first_].count == asked_ && !setup_.camera.has_lens())
        if (const auto middle = on_plane(
                p, static_cast<double>(column_) + 0.5, static_cast<double>(row_) + 0.5))
            p.at = *middle;
    return p;
}

/// To where the neighbouring pixels look, on the tangent plane.
void PilotLook::write_steps(PixelGeometry& g) const {
    const SeenPlace p = place_of(first_);
    const double x = static_cast<double>(column_) + 0.5;
    const double y = static_cast<double>(row_) + 0.5;
    const auto here = on_plane(p, x, y);
    const auto right = on_plane(p, x + 1.0, y);
    const auto below = on_plane(p, x, y + 1.0);
    if (here && right)
        g.column_step.set(pixel_, *right - *here);
    if (here && below)
        g.row_step.set(pixel_, *below - *here);
}

void PilotLook::write_geometry(PixelBuffers& buffers) const {
    PixelGeometry& g = buffers.geometry;
    if (clusters_used_ == 0)
        return;
    const auto write = [&](PixelSurface& surface, std::size_t cluster) {
        const Cluster& c = clusters_[cluster];
        surface.object[pixel_] = c.object;
        surface.normal.set(pixel_, Vector3(UnitVector3(c.normal)));
    };
    write(g.first, first_);
    if (second_ < clusters_used_)
        write(g.second, second_);
    const Cluster& c = clusters_[first_];
    const double n = static_cast<double>(c.count);
    g.position.set(pixel_, first_place().at - g.origin);
    g.depth[pixel_] = static_cast<float>(c.depth / n);
    g.coverage[pixel_] = static_cast<float>(n / static_cast<double>(asked_));
    write_steps(g);
    if (!setup_.camera.has_lens())
        return;
    double low = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < used_; ++s)
        low = std::min(low, std::abs(setup_.camera.lens_shift(samples_[s].depth_on_axis)));
    g.lens_shift_min[pixel_] = static_cast<float>(low);
}

void PilotLook::write_plan(PilotPlanes& pilot) const {
    pilot.has_more[pixel_] = has_more_ ? 1 : 0;
    pilot.has_luminaire[pixel_] = on_luminaire_;
    constexpr double inverse_pi = 0.318309886183790671538;
    double reflected = 0.0;
    for (const SeenSurface& seen : on_first())
        reflected += seen.throughput * luminance_sum(seen.diffuse);
    pilot.reflected[pixel_] =
        static_cast<float>(inverse_pi * reflected / static_cast<double>(asked_));
}

} // namespace isolux
