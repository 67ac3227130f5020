#!/bin/sh
# Builds the comparison with Ceres (Debian: apt-get install libceres-dev).
set -e
cd "$(dirname "$0")"
${CXX:-g++} -O3 -DNDEBUG -std=c++17 -I/usr/include/eigen3 peer.cpp -o peer -lceres -lglog -lgflags
