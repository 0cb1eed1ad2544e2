#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include "explore/floor/floor_plan.hpp"

namespace lapwing::explore::testing {

/// A floor as letters: `#` is a wall, ` ` free, `?` unknown; each letter is a square of `side_m`. The first line is the
/// highest.
inline map::OccupancyGrid drawn_grid(std::vector<std::string_view> const& lines, double side_m = 0.5,
                                     double cell_m = 0.1) {
  map::OccupancyGrid grid(cell_m);
  int const cells = static_cast<int>(std::lround(side_m / cell_m));
  int const rows = static_cast<int>(lines.size());
  for (int row = 0; row < rows; ++row) {
    auto const line = lines[static_cast<std::size_t>(row)];
    for (int column = 0; column < static_cast<int>(line.size()); ++column) {
      char const letter = line[static_cast<std::size_t>(column)];
      if (letter == '?') continue;
      for (int y = 0; y < cells; ++y) {
        for (int x = 0; x < cells; ++x)
          grid.set({column * cells + x, (rows - 1 - row) * cells + y},
                   map::Evidence::of_probability(letter == '#' ? 0.97 : 0.03));
      }
    }
  }
  return grid;
}

inline std::vector<std::string_view> const two_rooms = {
    "####################",  //
    "#        #         #",  //
    "#        #         #",  //
    "#                  #",  //
    "#                  #",  //
    "#        #         #",  //
    "#        #         #",  //
    "####################",
};

inline std::vector<std::string_view> const island = {
    "##############################",  //
    "#                            #",  //
    "#                            #",  //
    "#                            #",  //
    "#    ####################    #",  //
    "#    #??????????????????#    #",  //
    "#    #??????????????????#    #",  //
    "#    ####################    #",  //
    "#                            #",  //
    "#                            #",  //
    "#                            #",  //
    "##############################",
};

inline std::vector<std::string_view> const dead_ends = {
    "########################################",  //
    "#     #      #      #      #      #    #",  //
    "#     #      #      #      #      #    #",  //
    "#     #      #      #      #      #    #",  //
    "###  #####  #####  #####  #####  ####  #",  //
    "#                                      #",  //
    "#                                      #",  //
    "#                                      #",  //
    "##  #####  #####  #####  #####  ####  ##",  //
    "#    #      #      #      #      #     #",  //
    "#    #      #      #      #      #     #",  //
    "#    #      #      #      #      #     #",  //
    "########################################",
};

/// A corridor in which two robots cannot pass each other, with dead ends.
inline std::vector<std::string_view> const narrow = {
    "#####################################",  //
    "#      #  #      #  #      #  #     #",  //
    "#      #  #      #  #      #  #     #",  //
    "#      #  #      #  #      #  #     #",  //
    "##  ####  ###  ###  ###  ###  ##  ###",  //
    "#                                   #",  //
    "#                                   #",  //
    "####  #####  ##################  ####",  //
    "#        ##  #                #     #",  //
    "#        ##  #                #     #",  //
    "#        ##  #                #     #",  //
    "#####################################",
};

/// A hall with pillars and alcoves: walls to follow that lead round in circles.
inline std::vector<std::string_view> const hall = {
    "############################################",  //
    "#                #      #                  #",  //
    "#                #      #                  #",  //
    "#                                          #",  //
    "#      ##              ##         ###      #",  //
    "#      ##              ##         ###      #",  //
    "#                                          #",  //
    "#                                          #",  //
    "#           ##                             #",  //
    "#           ##                 ##          #",  //
    "#                              ##          #",  //
    "#                  ###                     #",  //
    "#                  ###                  ####",  //
    "#    #                                  #  #",  //
    "#    #                                     #",  //
    "#    #                                     #",  //
    "############################################",
};

}  // namespace lapwing::explore::testing
