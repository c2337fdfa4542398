#pragma once

// What is wrong with a progressive file, where, and which rule says so.

#include "validators/validate.h"
