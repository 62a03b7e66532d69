#pragma once

// EACH(ACTION, of, first, second, ...) is ACTION(of, first) ACTION(of, second) and so on, for at
// most 80 names.
//
// A macro is not replaced within itself, so each name asks for one more replacement of what
// follows.
#define EACH(ACTION, of, ...) REPLACED(NEXT_NAME(ACTION, of, __VA_ARGS__))
#define NEXT_NAME(ACTION, of, name, ...) \
    ACTION(of, name) __VA_OPT__(NEXT_NAME_AGAIN PARENTHESES(ACTION, of, __VA_ARGS__))
#define NEXT_NAME_AGAIN() NEXT_NAME
#define PARENTHESES ()
#define REPLACED(...) REPLACED_16(REPLACED_16(REPLACED_16(REPLACED_16(__VA_ARGS__))))
#define REPLACED_16(...) REPLACED_4(REPLACED_4(REPLACED_4(REPLACED_4(__VA_ARGS__))))
#define REPLACED_4(...) REPLACED_1(REPLACED_1(REPLACED_1(REPLACED_1(__VA_ARGS__))))
#define REPLACED_1(...) __VA_ARGS__
