#pragma once

#include <optional>
#include <string>
#include <vector>

#include "isolux/io/project_reader.h"

namespace isolux {

/// The groups of observers that one entry of "requirements" is judged at: those that it names,
/// those of the project, or the grid that isolux adds.
class RequirementObservers {
public:
    /// @param own_groups  how many groups of observers the project itself names
    RequirementObservers(const JsonObject& entry, ProjectReader& reader, std::size_t own_groups)
        : entry_(entry), reader_(reader), own_groups_(own_groups) {}

    /// Reads "observers". @return false if something is wrong (and reported)
    bool read_own();

    /// @param room  may be null @pre read_own()
    [[nodiscard]] std::vector<std::size_t> of(const Requirement& r, const Room* room);

    /// A notice where observers are named that nothing is judged at. @param row  of the
    /// standard
    /// @param are_left_out  by the entry itself
    void check_use(const std::string& row, bool are_left_out) const;

private:
    [[nodiscard]] std::vector<std::size_t> observers_by_name(const Requirement& r,
                                                             GlareScale scale);
    [[nodiscard]] std::vector<std::size_t> find_observers(const Requirement& r,
                                                          GlareScale scale);
    [[nodiscard]] std::string grid_name() const;
    [[nodiscard]] std::optional<std::size_t> make_grid();
    [[nodiscard]] std::optional<std::size_t> find_group(const std::string& name) const;

    [[nodiscard]] std::vector<ObserverGroup>& groups() const {
        return reader_.project.observers;
    }

    const JsonObject& entry_;
    ProjectReader& reader_;
    std::size_t own_groups_;
    const Room* room_ = nullptr;
    std::vector<std::string> named_; ///< by the user; "grid" is the room's grid
    bool are_asked_ = false;
};

} // namespace isolux
