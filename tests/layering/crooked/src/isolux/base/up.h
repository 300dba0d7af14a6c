#pragma once

// A house built wrongly on purpose: the layering test must see every one of these.
#include <tbb/parallel_for.h>

#include "isolux/scene/scene.h"
