/* What every call of this folder returns. */
#ifndef SPINDLE_EBL_RESULT_H
#define SPINDLE_EBL_RESULT_H

typedef enum {
    EBL_OK = 0,
    EBL_ERROR_SPACE = -1,       /* the caller's buffer is too small */
    EBL_ERROR_LENGTH = -2,      /* bytes are missing */
    EBL_ERROR_RESERVED = -3,    /* header bit 2 is set */
    EBL_ERROR_VERSION = -4,     /* another major version */
    EBL_ERROR_UNKNOWN_MSG = -5, /* no such message id */
    EBL_ERROR_SHAPE = -6        /* rows and channels do not fill the payload */
} ebl_result;

#endif
