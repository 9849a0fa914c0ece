// SPDX-License-Identifier: Apache-2.0
// Holds nothing: its target compiles the headers that all tests share (CMakeLists.txt).
