#include "isolux/transport/light_path.h"
