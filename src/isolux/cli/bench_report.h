#pragma once

#include <string>
#include <vector>

#include "isolux/calc/efficiency.h"

/// What `isolux bench` prints.
namespace isolux {

struct BenchReport {
    BenchSettings settings;
    std::size_t threads = 0;
    std::vector<RoomBench> rooms;
    std::vector<ScalingRow> by_points;
    std::vector<ScalingRow> by_luminaires;          ///< in one hall
    std::vector<ScalingRow> by_luminaires_and_size; ///< in a room that grows with them
};

/// One room: times to each error, efficiency with its spread, rays.
[[nodiscard]] std::string to_text(const RoomBench& room);

[[nodiscard]] std::string scaling_text(const std::string& title,
                                       const std::vector<ScalingRow>& rows);

[[nodiscard]] std::string to_json(const BenchReport& report);

} // namespace isolux
