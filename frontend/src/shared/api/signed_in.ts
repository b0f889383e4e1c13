// Whether somebody signed in with this browser, without a request: a server without accounts is
// sent none. The cookie holds no secret; the one that does is out of reach of scripts.
export const isSignedIn = (): boolean => document.cookie.includes('spindle_signed_in=')

export const SIGN_IN = 'sign-in'
/** Where the code of a bike is entered. */
export const PAIR = 'pair'

/** Pages without the others around them: who opens them may not be signed in. */
export const isAlone = (place: string): boolean => place === SIGN_IN || place === PAIR
