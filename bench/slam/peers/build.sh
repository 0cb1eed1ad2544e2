#!/usr/bin/env bash
# build.sh SOURCES OUT: programs of the peers from their public sources, which SOURCES holds as open_karto, openslam_gmapping and cartographer (this one built there
# in `build` by its own CMake). Those that are absent are left out. Debian: libceres-dev liblua5.3-dev libgoogle-glog-dev libgflags-dev libprotobuf-dev
# protobuf-compiler libabsl-dev libcairo2-dev libboost-iostreams-dev.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
sources=$(cd "$1" && pwd)
mkdir -p "$2"
out=$(cd "$2" && pwd)
compile=(g++ -O2 -DNDEBUG -w -I"$here" -isystem /usr/include/eigen3)

if [[ -d $sources/open_karto ]]; then
  "${compile[@]}" -std=c++20 -I"$sources/open_karto/include" "$here/karto.cpp" "$sources"/open_karto/src/{Karto,Mapper}.cpp \
    -lceres -lglog -lboost_thread -lboost_system -lpthread -o "$out/karto"
fi
if [[ -d $sources/openslam_gmapping ]]; then
  parts=("$sources"/openslam_gmapping/{gridfastslam/{gridslamprocessor,gridslamprocessor_tree,motionmodel},scanmatcher/{eig3,scanmatcher,scanmatcherprocessor,smmap}}.cpp
    "$sources"/openslam_gmapping/{sensor/sensor_base/{sensor,sensorreading},sensor/sensor_odometry/{odometrysensor,odometryreading},sensor/sensor_range/{rangesensor,rangereading},utils/{movement,stat}}.cpp)
  # What its own build generates with ROS' tools: which symbols a shared library shows. And it is older than C++17; the driver is of today.
  (cd "$sources/openslam_gmapping/include" && grep -rhoE 'gmapping/[a-z_/]*_export\.h' . | sort -u) | while read -r header; do
    mkdir -p "$out/include/$(dirname "$header")"
    word=$(basename "$header" .h | tr a-z A-Z)
    echo "#define $word" > "$out/include/$header"
  done
  for part in "${parts[@]}"; do "${compile[@]}" -std=c++14 -I"$sources/openslam_gmapping/include" -I"$out/include" -c "$part" -o "$out/gmapping-$(basename "$part" .cpp).o"; done
  "${compile[@]}" -std=c++20 -I"$sources/openslam_gmapping/include" -I"$out/include" "$here/gmapping.cpp" "$out"/gmapping-*.o -o "$out/gmapping"
  rm -r "$out"/gmapping-*.o "$out/include"
fi
if [[ -f $sources/cartographer/build/libcartographer.a ]]; then
  "${compile[@]}" -std=c++17 -I"$sources/cartographer" -I"$sources/cartographer/build" -I/usr/include/lua5.3 -DLAPWING_PEERS_FOLDER="\"$here\"" \
    -DCARTOGRAPHER_SETTINGS="\"$sources/cartographer/configuration_files\"" "$here/cartographer.cpp" "$sources/cartographer/build/libcartographer.a" \
    $(pkg-config --libs absl_strings absl_synchronization absl_str_format absl_flat_hash_map absl_time) -lceres -lprotobuf -lglog -lgflags -llua5.3 -lcairo -lboost_iostreams -lpthread \
    -o "$out/cartographer"
fi
ls "$out"
