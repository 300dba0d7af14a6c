#include "isolux/viz/photometric_web.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "isolux/scene/luminaire_body.h"
#include "isolux/viz/space_view.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double body_share = 0.55;  ///< longest side of the body over the web's radius
constexpr double body_height = 0.22; ///< at most, over the same

const Colour web_colour{245, 200, 80};
const Colour body_colour{120, 130, 145};
const Colour c0_colour{190, 30, 30};
const Colour axis_colour{20, 90, 60};

Point3 polar_point(double radius, double c, double gamma) {
    return {radius * std::sin(gamma) * std::cos(c),
            radius * std::sin(gamma) * std::sin(c),
            -radius * std::cos(gamma)};
}

double intensity(const LuminaireType& type, double c, double gamma) {
    const Point3 d = polar_point(1.0, c, gamma);
    return luminous_intensity(type, UnitVector3::from_unit(d - Point3{})).value();
}

double largest_intensity(const LuminaireType& type) {
    double largest = 0.0;
    for (int c = 0; c < 360; c += 5)
        for (int g = 0; g <= 360; ++g)
            largest = std::max(largest, intensity(type, c * pi / 180.0, g * pi / 360.0));
    return largest;
}

/// Gammas that follow the solid: even steps of the profile's length and of the angle together,
/// so that narrow beams get the nodes they need.
std::vector<double> choose_gammas(const LuminaireType& type, double largest, int count) {
    constexpr int fine = 720;
    std::vector<double> travelled{0.0};
    Point2 last;
    for (int k = 0; k <= fine; ++k) {
        const double g = k * pi / fine;
        double profile = 0.0;
        for (int c = 0; c < 360; c += 15)
            profile = std::max(profile, intensity(type, c * pi / 180.0, g) / largest);
        const Point2 here{profile * std::sin(g), profile * std::cos(g)};
        if (k > 0)
            travelled.push_back(travelled.back() + std::hypot(here.x - last.x, here.y - last.y)
                                + 1.0 / fine);
        last = here;
    }
    std::vector<double> gammas;
    std::size_t k = 0;
    for (int n = 0; n <= count; ++n) {
        const double wanted = travelled.back() * n / count;
        while (k + 1 < travelled.size() && travelled[k] < wanted - 1e-12)
            ++k;
        gammas.push_back(static_cast<double>(k) * pi / fine);
    }
    return gammas;
}

void add_web(std::vector<SpacePiece>& pieces,
             const LuminaireType& type,
             double largest,
             const SpaceView& view) {
    constexpr int sectors = 48;
    const std::vector<double> gammas = choose_gammas(type, largest, 44);
    const auto corner = [&](int sector, std::size_t g) {
        const double c = 2.0 * pi * sector / sectors;
        return polar_point(intensity(type, c, gammas[g]) / largest, c, gammas[g]);
    };
    for (std::size_t g = 0; g + 1 < gammas.size(); ++g)
        for (int s = 0; s < sectors; ++s) {
            SpacePiece p;
            p.corners = {
                corner(s, g), corner(s + 1, g), corner(s + 1, g + 1), corner(s, g + 1)};
            if (length(p.corners[2] - p.corners[0]) + length(p.corners[3] - p.corners[1])
                < 2e-3)
                continue; // no light there
            p.fill = shade(web_colour, view.light_on(p.corners));
            p.opacity = 0.72;
            p.stroke = {shade(p.fill, 0.72), 0.07, 0.0};
            pieces.push_back(std::move(p));
        }
}

void add_body(std::vector<SpacePiece>& pieces,
              const LuminousOpening& body,
              const SpaceView& view) {
    const std::array<double, 3> size{
        in_metre(body.extent_x), in_metre(body.extent_y), in_metre(body.extent_z)};
    const double longest = std::max({size[0], size[1], size[2]});
    if (!(longest > 0.0))
        return;
    const double scale =
        0.5
        * std::min(body_share / longest, size[2] > 0.0 ? body_height / size[2] : body_share);
    const bool is_round = body.shape == OpeningShape::ellipse
                          || body.shape == OpeningShape::vertical_cylinder
                          || body.shape == OpeningShape::ellipsoid;
    const int corners = is_round ? 32 : 4;
    const double stretch = is_round ? 1.0 : std::numbers::sqrt2;
    const double z = scale * std::max(size[2], 0.02 * longest);
    std::array<std::vector<Point3>, 2> rings;
    for (int k = 0; k < corners; ++k) {
        const double a = 2.0 * pi * (k + 0.5) / corners;
        const double x = stretch * scale * size[0] * std::cos(a);
        const double y = stretch * scale * size[1] * std::sin(a);
        rings[0].push_back({x, y, -z});
        rings[1].push_back({x, y, z});
    }
    const auto add = [&](std::vector<Point3> face) {
        SpacePiece p;
        p.fill = shade(body_colour, view.light_on(face));
        p.stroke = {shade(body_colour, 0.45), 0.15, 0.0};
        p.corners = std::move(face);
        pieces.push_back(std::move(p));
    };
    add(rings[0]);
    add(rings[1]);
    for (std::size_t k = 0; k < rings[0].size(); ++k) {
        const std::size_t n = (k + 1) % rings[0].size();
        add({rings[0][k], rings[0][n], rings[1][n], rings[1][k]});
    }
}

SpacePiece line_piece(std::vector<Point3> corners, const Stroke& stroke) {
    SpacePiece p;
    p.corners = std::move(corners);
    p.stroke = stroke;
    p.ends = Ends::open;
    return p;
}

/// A line in short pieces, so that each finds its place between the others.
void add_line(std::vector<SpacePiece>& pieces,
              const Point3& a,
              const Point3& b,
              const Stroke& s) {
    constexpr int parts = 14;
    for (int k = 0; k < parts; ++k) {
        const double from = static_cast<double>(k) / parts;
        const double to = (k + 1.0) / parts;
        pieces.push_back(line_piece({a + from * (b - a), a + to * (b - a)}, s));
    }
}

constexpr double plane_radius = 1.12;
constexpr double arrow_length = 1.28;

/// The horizontal plane: a ring, the four half-planes, an arrow towards C0.
void add_plane(std::vector<SpacePiece>& pieces) {
    const Stroke thin{ink::grey, 0.14, 0.0};
    for (int k = 0; k < 360; k += 5)
        pieces.push_back(line_piece({polar_point(plane_radius, k * pi / 180.0, 0.5 * pi),
                                     polar_point(plane_radius, (k + 5) * pi / 180.0, 0.5 * pi)},
                                    thin));
    for (int k = 1; k < 4; ++k)
        add_line(pieces, {}, polar_point(plane_radius, 0.5 * k * pi, 0.5 * pi), thin);
    const Stroke red{c0_colour, 0.55, 0.0};
    add_line(pieces, {}, {arrow_length, 0.0, 0.0}, red);
    SpacePiece head;
    head.corners = {{arrow_length + 0.1, 0.0, 0.0},
                    {arrow_length - 0.02, 0.05, 0.0},
                    {arrow_length - 0.02, -0.05, 0.0}};
    head.fill = c0_colour;
    head.stroke = {c0_colour, 0.1, 0.0};
    pieces.push_back(std::move(head));
}

/// Centre line of the body along its longer horizontal side.
void add_long_axis(std::vector<SpacePiece>& pieces, const LongSide& side, double dash) {
    const double reach = 0.5 * body_share + 0.16;
    const Point3 end = side.is_along_y ? Point3{0.0, reach, 0.0} : Point3{reach, 0.0, 0.0};
    if (dash > 0.0)
        pieces.push_back(line_piece({{-end.x, -end.y, 0.0}, end}, {axis_colour, 0.25, dash}));
    else
        add_line(pieces, {-end.x, -end.y, 0.0}, end, {axis_colour, 0.4, 0.0});
}

/// The body's edges again, for where light hides it.
std::vector<SpacePiece> hidden_lines(std::vector<SpacePiece> body) {
    for (SpacePiece& p : body) {
        p.ends = Ends::open;
        p.corners.push_back(p.corners.front());
        p.stroke = {{60, 65, 75}, 0.1, 0.6};
    }
    if (body.size() > 6) // a round one: its two rings will do
        body.resize(2);
    return body;
}

void write_names(Drawing& page, const SpaceView& view) {
    constexpr double size = 2.5;
    constexpr std::array<const char*, 4> names{"C0", "C90", "C180", "C270"};
    for (std::size_t k = 0; k < names.size(); ++k) {
        const double r = k == 0 ? arrow_length + 0.2 : plane_radius + 0.12;
        Point2 at = view.on_page(polar_point(r, 0.5 * pi * static_cast<double>(k), 0.5 * pi));
        at.y += 0.5 * cap_height * size;
        Text t = make_text(names[k],
                           at,
                           size,
                           Anchor::middle,
                           k == 0 ? Weight::bold : Weight::normal,
                           k == 0 ? c0_colour : ink::black);
        t.halo = ink::white;
        page.items.emplace_back(std::move(t));
    }
}

} // namespace

WebMesh make_web_mesh(const LuminaireType& type) {
    const double largest = largest_intensity(type);
    const std::vector<double> gammas = choose_gammas(type, largest > 0.0 ? largest : 1.0, 40);
    WebMesh mesh{48, gammas.size(), {}, {}};
    for (const double gamma : gammas)
        for (std::size_t s = 0; s < mesh.sectors; ++s) {
            const double c =
                2.0 * pi * static_cast<double>(s) / static_cast<double>(mesh.sectors);
            mesh.candela.push_back(intensity(type, c, gamma));
            mesh.points.push_back(
                polar_point(largest > 0.0 ? mesh.candela.back() / largest : 0.0, c, gamma));
        }
    return mesh;
}

void draw_web(Drawing& page,
              const Box& box,
              const LuminaireType& type,
              const ViewAngles& angles) {
    SpaceView view(angles, box);
    const double largest = largest_intensity(type);
    std::vector<SpacePiece> pieces;
    if (largest > 0.0)
        add_web(pieces, type, largest, view);
    add_plane(pieces);
    std::vector<SpacePiece> body;
    add_body(body, visible_body(type), view);
    pieces.insert(pieces.end(), body.begin(), body.end());
    std::vector<SpacePiece> hidden = hidden_lines(std::move(body));
    if (const auto side = find_long_side(type)) {
        add_long_axis(pieces, *side, 0.0);
        add_long_axis(hidden, *side, 0.8);
    }
    view.fit(pieces, 5.0);
    view.paint(page, std::move(pieces));
    view.paint(page, std::move(hidden));
    write_names(page, view);
}

} // namespace isolux
