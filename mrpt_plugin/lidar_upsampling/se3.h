#pragma once
#include "lidar_upsampling/ego/se3.h"
