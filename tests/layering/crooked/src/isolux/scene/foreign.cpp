#include <vtkPolyData.h>

#include "neighbour.h"
