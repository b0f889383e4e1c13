/* The configuration as the law wants it. */
#ifndef SPINDLE_CONFIG_LAW_H
#define SPINDLE_CONFIG_LAW_H

#include "assist.h"       // assist_config
#include "ebl_registry.h" // ebl_config

/* The law's view of a configuration; `step_s` is the control period. */
void config_law_from(const ebl_config *config, assist_config *assist);

#endif
