// Exists so that the headers all tests share are precompiled once (tests/CMakeLists.txt).
