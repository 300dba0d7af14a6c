#pragma once

#include <string>

namespace isolux::report {

/// Every word a report says. Another language is another file like english.cpp. Members with {}
/// are patterns of fmt, their values in the order of the braces.
struct Texts {
    std::string language; ///< BCP 47

    // cover
    std::string kind;
    std::string cover_caption;
    std::string project;
    std::string project_file;
    std::string date;
    std::string no_date;
    std::string program;
    std::string program_value; ///< version
    std::string accuracy;
    std::string accuracy_value; ///< tolerance, confidence
    std::string state;
    std::string state_converged;
    std::string state_open;
    std::string state_interrupted;
    std::string contents;
    std::string footer; ///< project, version

    // verdict
    std::string verdict_title;
    std::string verdict_intro; ///< confidence
    std::string verdict_caption;
    std::string requirement;
    std::string standard;
    std::string limit;
    std::string margin;
    std::string verdict;
    std::string pass;
    std::string fail;
    std::string undecided;
    std::string not_judged;
    std::string all_pass;
    std::string one_fails;
    std::string one_undecided;
    std::string none_judged;
    std::string recommended;
    std::string verdict_note; ///< place, symbol, remark
    std::string source_caption;
    std::string task;
    std::string clause;
    std::string source;
    std::string recalled;

    // glare, energy, scenes
    std::string glare;
    std::string glare_intro;
    std::string glare_caption;
    std::string observers;
    std::string sight_lines;
    std::string scale;
    std::string worst;
    std::string eye;
    std::string looking;
    std::string by_table;
    std::string ratings_caption; ///< observers, scale
    std::string background;
    std::string energy;
    std::string energy_caption;
    std::string watts;
    std::string density;
    std::string density_per_100_lux;
    std::string leni;
    std::string scenes;
    std::string scenes_intro;
    std::string scene_caption; ///< scene
    std::string maintenance_caption;
    std::string maintenance_factor;

    // overview
    std::string overview;
    std::string overview_intro; ///< confidence
    std::string surfaces_caption;
    std::string surface;
    std::string quantity;
    std::string points;
    std::string mean;
    std::string minimum;
    std::string maximum;
    std::string uniformity;
    std::string diversity;
    std::string lux;
    std::string reached;
    std::string yes;
    std::string no;
    std::string notices;
    std::string place;
    std::string notice;

    // luminaires
    std::string luminaires;
    std::string schedule_caption;
    std::string number;
    std::string type;
    std::string product;
    std::string count;
    std::string flux_each;
    std::string flux_all;
    std::string watts_each;
    std::string watts_all;
    std::string not_stated;
    std::string total;
    std::string schedule_note;
    std::string polar_caption;     ///< type
    std::string polar_alternative; ///< type, largest intensity, C, gamma
    std::string facts_caption;     ///< number, type
    std::string manufacturer;
    std::string catalogue_number;
    std::string file;
    std::string lamps;
    std::string flux;
    std::string power;
    std::string power_value; ///< W, lm/W
    std::string light_output_ratio;
    std::string downward_share;
    std::string largest_intensity;
    std::string largest_intensity_value; ///< cd, C, gamma
    std::string beam;
    std::string beam_value; ///< C0-C180, C90-C270
    std::string body;
    std::string long_side;
    std::string aligned;
    std::string legend; ///< of the two planes
    std::string positions_caption;
    std::string luminaire;
    std::string c0_direction;
    std::string tilt;
    std::string light_share;
    std::string group;
    std::string positions_note;

    // rooms
    std::string rooms;
    std::string room_caption;     ///< room
    std::string room_alternative; ///< room, number of luminaires, calculation surfaces
    std::string rooms_table;
    std::string finishes_table;
    std::string room_or_object;
    std::string part;
    std::string material;
    std::string diffuse_share;
    std::string mirror_share;
    std::string transmittance;
    std::string room;
    std::string area;
    std::string surface_area;
    std::string height;
    std::string luminaire_count;
    std::string plan_caption;

    // surfaces
    std::string surface_title; ///< surface
    std::string figures_caption;
    std::string value;
    std::string lower;
    std::string upper;
    std::string map_caption;     ///< surface, confidence
    std::string map_alternative; ///< surface, quantity, mean, minimum, maximum
    std::string values_caption;  ///< surface, unit
    std::string point;
    std::string direct;
    std::string indirect;
    std::string values_cut; ///< shown, all
    std::string flag_note;
    std::string not_reached;

    // pictures
    std::string views;
    std::string view_caption; ///< file

    // method
    std::string method;
    std::string method_intro;
    std::string method_caption;
    std::string estimator;
    std::string seed;
    std::string tolerance;
    std::string confidence;
    std::string confidence_value; ///< asked for, of each interval
    std::string replicates;
    std::string paths;
    std::string rays;
    std::string flux_balance;
    std::string flux_balance_value; ///< emitted, absorbed, escaped
    std::string self_test;
    std::string self_test_value; ///< rows passed, rows in all, version, seed
    std::string self_test_absent;
    std::string duration;
    std::string duration_value; ///< wall, cpu
    std::string budget_title;
    std::string budget_intro; ///< assumptions
    std::string budget_caption;
    std::string monte_carlo;
    std::string photometry;
    std::string assumed_flux;
    std::string reflectance;
    std::string maintenance;
    std::string combined;
    std::string hashes_title;
    std::string hashes_intro;
    std::string hashes_caption;
    std::string sha256;
};

[[nodiscard]] const Texts& english();

} // namespace isolux::report
