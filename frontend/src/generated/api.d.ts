// Generated from the API's description by `npm run gen`; do not edit.

export interface paths {
    "/api/v1/health": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Health
         * @description Whether everything that is to be kept is kept, and how each unit is.
         */
        get: operations["get_health"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/server/addresses": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Addresses
         * @description By which addresses a phone reaches this server, and how it knows the certificate.
         */
        get: operations["get_addresses"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/store": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Store
         * @description Where rides, units and settings are kept, how large that is, and how much room is left.
         */
        get: operations["get_store"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/store/backup": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Backup
         * @description Everything that is kept, at this moment, as a zip; unpacked into an empty folder it is a data
         *     folder. The database is checked before the first byte; its `backup.json` names what lacks.
         */
        get: operations["get_backup"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/session": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Session
         * @description Whether people sign in here, and who asks.
         */
        get: operations["get_session"];
        put?: never;
        post?: never;
        /**
         * Sign Out
         * @description Ends this session.
         */
        delete: operations["sign_out"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/sign-in": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Sign In
         * @description Begins a session: its token goes into a cookie that no script reads.
         */
        post: operations["sign_in"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/first-person": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Make First Person
         * @description The first administrator, by the link that the server printed; signs them in.
         */
        post: operations["make_first_person"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/session/password": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        /**
         * Change Own Password
         * @description Gives oneself another password; every other browser is signed out.
         */
        put: operations["change_own_password"];
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tickets": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Give Ticket
         * @description Opens one WebSocket without a header: for programs. A browser's cookie does by itself.
         */
        post: operations["give_ticket"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/people": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List People
         * @description Everybody with an account, by name.
         */
        get: operations["list_people"];
        put?: never;
        /**
         * Add Person
         * @description A new account.
         */
        post: operations["add_person"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/people/{person_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /**
         * Remove Person
         * @description Removes an account with its sessions, passkeys and keys. What it did stays under its name.
         */
        delete: operations["remove_person"];
        options?: never;
        head?: never;
        /**
         * Change Person
         * @description Another name, role or password, or disabled; with the last two every browser is signed out,
         *     with another password the passkeys are removed.
         *
         *     What was done under the name before keeps that name.
         */
        patch: operations["change_person"];
        trace?: never;
    };
    "/api/v1/keys": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Keys
         * @description Every key, newest first, revoked ones too; one's own where others' are not one's affair.
         */
        get: operations["list_keys"];
        put?: never;
        /**
         * Add Key
         * @description A new key. It is in this answer and nowhere else: only its hash is kept.
         *
         *     For oneself; for others by who manages people. Nobody gives more than they have. With `bike_id`
         *     it can only send files, of that bike: a rider's own.
         */
        post: operations["add_key"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/keys/{key_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /**
         * Revoke Key
         * @description Ends a key, one's own or, by who manages people, anybody's; it stays in the list.
         */
        delete: operations["revoke_key"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/session/passkeys": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Passkeys
         * @description One's own, the oldest first, of every name of this server.
         */
        get: operations["list_passkeys"];
        put?: never;
        /**
         * Add Passkey
         * @description Takes what the authenticator made: from now on it signs in, at this name alone.
         */
        post: operations["add_passkey"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/session/passkeys/challenges": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Begin Passkey
         * @description What `navigator.credentials.create` makes a passkey of, for this browser and five minutes.
         */
        post: operations["begin_passkey"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/session/passkeys/{passkey_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /**
         * Remove Passkey
         * @description Ends one of one's own. Browsers that signed in with it stay signed in.
         */
        delete: operations["remove_passkey"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/sign-in/passkey/challenges": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Begin Passkey Sign In
         * @description What `navigator.credentials.get` signs, within five minutes.
         */
        post: operations["begin_passkey_sign_in"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/sign-in/passkey": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Sign In With Passkey
         * @description Begins a session as a password does.
         */
        post: operations["sign_in_with_passkey"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/audit": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Audit
         * @description Newest first; `next` is the cursor of the following page, or null.
         *
         *     What was done to accounts and keys is shown to who manages people alone.
         */
        get: operations["list_audit"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/audit/export": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Export Audit
         * @description All of them as a file, oldest first.
         *
         *     In `jsonl` each line is an event as it was hashed: its `sha256` is that of the line's object
         *     without `sha256`, names sorted, no blanks, ASCII.
         */
        get: operations["export_audit"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/bikes": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Bikes
         * @description Every bike by name, with unit, owner and rides; a rider's own.
         */
        get: operations["list_bikes"];
        put?: never;
        /**
         * Add Bike
         * @description A bike without a unit: a unit that connects has one by itself.
         */
        post: operations["add_bike"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/bikes/{bike_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Bike
         * @description One bike; for the workshop with everybody who had it.
         */
        get: operations["get_bike"];
        put?: never;
        post?: never;
        /**
         * Remove Bike
         * @description Removes a bike without a history: 409 `bike_in_use` where it has one.
         */
        delete: operations["remove_bike"];
        options?: never;
        head?: never;
        /**
         * Change Bike
         * @description What a bike is, which unit is on it, or that it is lost; its owner says name and loss.
         */
        patch: operations["change_bike"];
        trace?: never;
    };
    "/api/v1/bikes/{bike_id}/rides": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Give Rides
         * @description Rides were made with this bike. Those that are nobody's are of whom it was then.
         */
        post: operations["give_rides"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/bikes/{bike_id}/pairing": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Pair Bike
         * @description A code for a week: whoever takes it owns the bike from then on, and whose it was has the
         *     rides of before. A code that was made earlier is none any more.
         */
        post: operations["pair_bike"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/bikes/{bike_id}/owner": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /**
         * Leave Bike
         * @description The bike is nobody's from now on; rides stay whose they are.
         */
        delete: operations["leave_bike"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/pairings/{code}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Pairing
         * @description Which bike a code gives. Wrong codes have to wait longer and longer.
         */
        get: operations["get_pairing"];
        put?: never;
        /**
         * Take Pairing
         * @description Makes the signed-in user the owner.
         */
        post: operations["take_pairing"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/pairings/{code}/account": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Join By Pairing
         * @description A rider's account, by the code of their bike; signs them in.
         */
        post: operations["join_by_pairing"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/checks": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Check Unit
         * @description What can be checked of a unit without touching it, done now: what was found, what is allowed,
         *     and whether it passed.
         */
        get: operations["check_unit"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/support": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Support File
         * @description What a unit says of itself, for who helps from afar; also of one that is away. No names, no
         *     addresses, no rides.
         */
        get: operations["get_support_file"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/bikes/{bike_id}/visits": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Visits
         * @description The visits of a bike, the newest first; for its owner without other people's names.
         */
        get: operations["list_visits"];
        put?: never;
        /**
         * Open Visit
         * @description Begins a visit, and looks at the unit if one is named. 409 `visit_open` where one is open.
         */
        post: operations["open_visit"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/visits/{visit_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Visit
         * @description One visit; of an open one with what is otherwise by now.
         */
        get: operations["get_visit"];
        put?: never;
        post?: never;
        /**
         * Remove Visit
         * @description Removes an open visit that was begun by mistake; a closed one stays.
         */
        delete: operations["remove_visit"];
        options?: never;
        head?: never;
        /**
         * Change Visit
         * @description Writes in an open visit; what is absent stays.
         */
        patch: operations["change_visit"];
        trace?: never;
    };
    "/api/v1/visits/{visit_id}/readings": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Look At Unit
         * @description Looks at the unit now: checks and faults. The first look is `before`, the last `after`.
         */
        post: operations["look_at_unit"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/visits/{visit_id}/close": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Close Visit
         * @description Ends a visit with what is otherwise by now. Nothing but the consent is changed after.
         */
        post: operations["close_visit"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/visits/{visit_id}/consent": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Consent To Visit
         * @description The owner agrees with what was done: by their account, or by a signature in the workshop.
         */
        post: operations["consent_to_visit"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/visits/{visit_id}/photos": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Add Visit Photo
         * @description Keeps a photograph of up to 32 MiB: upright, 1600 px at most, without what the camera wrote
         *     into the file.
         */
        post: operations["add_visit_photo"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/visits/{visit_id}/photos/{sha256}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Visit Photo
         * @description A photograph as JPEG.
         */
        get: operations["get_visit_photo"];
        put?: never;
        post?: never;
        /**
         * Remove Visit Photo
         * @description Takes a photograph out of an open visit, for good.
         */
        delete: operations["remove_visit_photo"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/bikes/{bike_id}/history": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Bike History
         * @description The closed visits of a bike as one file that goes on with it, without the names of who
         *     brought it or signed.
         */
        get: operations["get_bike_history"];
        put?: never;
        /**
         * Add Bike History
         * @description Adds the visits of such a file that are not here yet, all or none. Up to 512 MiB.
         */
        post: operations["add_bike_history"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibration/evaluate": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Evaluate Calibration
         * @description Linearity, hysteresis and repeatability of a sensor from its readings.
         */
        post: operations["evaluate_calibration"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/config/revisions/{seq}/since": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Since Revision
         * @description The unit's rides since this configuration beside those before it.
         */
        get: operations["since_revision"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/ports": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Ports
         * @description Serial ports of this machine, and the simulated unit.
         */
        get: operations["list_ports"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Devices
         * @description Every unit that was added and not removed, whatever its state.
         */
        get: operations["list_devices"];
        put?: never;
        /**
         * Add Device
         * @description Opens a unit; it connects, and reconnects, in the background.
         *
         *     The same url again is the same device, and may give its unit a name.
         */
        post: operations["add_device"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Device
         * @description One unit: who it is, how its link is, and why.
         */
        get: operations["get_device"];
        put?: never;
        post?: never;
        /**
         * Remove Device
         * @description Lets a unit go; a simulated one ends. Its rides and revisions stay.
         */
        delete: operations["remove_device"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/snapshot": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Snapshot
         * @description The newest value of every channel, asked of the unit.
         */
        get: operations["get_snapshot"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/service": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Service
         * @description How far and how long the unit ran, and how worn the flash of its configuration is.
         */
        get: operations["get_service"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/dashboard": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Dashboard
         * @description Speed, acceleration, powers, battery, distance and range, from the rows of the stream.
         */
        get: operations["get_dashboard"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/faults": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Faults
         * @description The faults that are active in the unit or were, and what the bike did when they came.
         */
        get: operations["list_faults"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/faults/clear": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Clear Faults
         * @description Ends latched faults whose cause has been gone for a second, if the bike stands still, and
         *     forgets those that are over. Lists what is left: whatever still has its cause, and all that is
         *     active while the bike moves.
         */
        post: operations["clear_faults"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/scenarios": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Scenarios
         * @description The scenarios that a simulated unit can ride.
         */
        get: operations["list_scenarios"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/simulation": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Simulation
         * @description Rider, road and clock of a simulated unit; 409 for a real one.
         */
        get: operations["get_simulation"];
        /**
         * Put Simulation
         * @description Changes what the body names and leaves the rest.
         */
        put: operations["put_simulation"];
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/simulation/advance": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Advance Simulation
         * @description Lets time pass for a unit with a virtual clock, as fast as it can; 409 for any other.
         */
        post: operations["advance_simulation"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/faults/{fault_name}/moment": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Moment Of Fault
         * @description The rider's and the motor's torque around a fault, from the ride it came on, else from the
         *     last minutes of the stream.
         */
        get: operations["moment_of_fault"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/marks": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Mark Moment
         * @description Marks the newest moment of the ride that is being recorded; it is among the ride's events.
         */
        post: operations["mark_moment"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/logs": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Logs
         * @description Rides the unit has recorded by itself; 409 for a unit that keeps none.
         */
        get: operations["list_logs"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/logs/{log_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /**
         * Erase Log
         * @description Frees a log in the unit's flash; 409 unless it was fetched and the unit knows that.
         */
        delete: operations["erase_log"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/logs/{log_id}/download": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Log Download
         * @description How far a download is, and what became of it.
         */
        get: operations["get_log_download"];
        put?: never;
        /**
         * Start Log Download
         * @description Fetches a log in the background and makes it a ride; goes on where an earlier try ended.
         */
        post: operations["start_log_download"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/parameters": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Parameters
         * @description Every parameter with its bounds, its meaning and its value in the unit now.
         */
        get: operations["list_parameters"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/config": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Config
         * @description The whole configuration, read from the unit; 404 where it never had a previous one.
         */
        get: operations["get_config"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        /**
         * Patch Config
         * @description Writes all the named parameters or none, reads them back and compares field by field.
         */
        patch: operations["patch_config"];
        trace?: never;
    };
    "/api/v1/devices/{device_id}/last-known": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Last Known
         * @description What the unit was last known to be set to, connected or not, over a restart too.
         *
         *     For reading: what is written goes to a connected unit only. What was on trial is left out. 404
         *     `never_read` where no configuration is kept.
         */
        get: operations["get_last_known"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/config/confirm": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Confirm Config
         * @description Keeps the change on trial, once it was read back and compared field by field.
         */
        post: operations["confirm_config"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/config/rollback": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Rollback Config
         * @description Gives up the change on trial: the unit has what it had before.
         */
        post: operations["rollback_config"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/config/revisions": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Revisions
         * @description Who changed what, when and why, newest first.
         */
        get: operations["list_revisions"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/why": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Why Of Device
         * @description Why this unit would give what it gives in a steady state, with what it is set to now.
         */
        post: operations["why_of_device"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/trial-values": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Trial Values
         * @description What is on trial in the unit's memory now, and until when.
         */
        get: operations["get_trial_values"];
        put?: never;
        /**
         * Set Trial Values
         * @description Puts values on trial at once, standing or moving; a restart, a commit or the time ends it.
         */
        post: operations["set_trial_values"];
        /**
         * End Trial Values
         * @description Ends what is on trial: the law runs on the configuration again.
         */
        delete: operations["end_trial_values"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/parts/{part}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Part
         * @description A part of the configuration in the shape people edit.
         *
         *     `fuzzy_table`: a rule table and its points, as the surface and the linter take them.
         *     `assist_modes`: the five slots of the rider's switch. `calibration`: how raw counts become
         *     newton metres. `limits`: what the unit enforces whatever the table says, and where assist ends
         *     because of it.
         */
        get: operations["get_part"];
        /**
         * Put Part
         * @description Writes a whole part in one transaction; the unit refuses what its market forbids.
         *
         *     Both tables share the points of speed and torque rate: those of the second are not changed here.
         */
        put: operations["put_part"];
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibrations": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Calibrations
         * @description Calibrations, newest first, of a unit or a bike where it is named.
         */
        get: operations["list_calibrations"];
        put?: never;
        /**
         * Open Calibration
         * @description Opens a calibration of a connected unit; 200 with the open one where there is one.
         */
        post: operations["open_calibration"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibrations/{calibration_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Calibration Job
         * @description All of a calibration: plan, captures, what follows from them, what was written, and the
         *     earlier ones of the bike and the model.
         */
        get: operations["get_calibration_job"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibrations/{calibration_id}/reading": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Calibration Reading
         * @description What the sensor reads now: the last 10 s, whether a capture can be taken, and why not.
         */
        get: operations["get_calibration_reading"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibrations/{calibration_id}/setup": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        /**
         * Set Up Calibration
         * @description Gives it its instruments and plan. A fit of before is one no more; captures stay.
         */
        put: operations["set_up_calibration"];
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibrations/{calibration_id}/captures": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Capture
         * @description Takes the newest 3 s as a reading of what hangs there. Refused with every reason unless they
         *     are steady; a zero also while the unit tells of a foot on the pedal.
         */
        post: operations["capture"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibrations/{calibration_id}/captures/{number}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /**
         * Strike Capture
         * @description Strikes a capture out: it counts no more, and stays with the reason.
         */
        delete: operations["strike_capture"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibrations/{calibration_id}/fit": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Fit Calibration
         * @description Holds what follows from the captures as the fit; refused by name where they contradict.
         */
        post: operations["fit_calibration"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibrations/{calibration_id}/write": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Write Calibration
         * @description Writes coefficients and record in one transaction, read back and compared. After an unknown
         *     outcome repeating it finds out.
         */
        post: operations["write_calibration"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibrations/{calibration_id}/verify": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Verify Calibration
         * @description Takes a reading at a mass that the fit has not seen and compares it.
         */
        post: operations["verify_calibration"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibrations/{calibration_id}/restore": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Restore Calibration
         * @description Writes back what the unit had before.
         */
        post: operations["restore_calibration"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibrations/{calibration_id}/close": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Close Calibration
         * @description Closes it: nothing of it changes any more, and it is a file.
         */
        post: operations["close_calibration"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibrations/{calibration_id}/certificate": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Calibration Certificate
         * @description The certificate as the file that `spindle calibrate evaluate` reads: the closed one's as it
         *     is kept; of an open one with a fit, as it would be now.
         */
        get: operations["get_calibration_certificate"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibrations/{calibration_id}/certificate.pdf": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Calibration Certificate Pdf
         * @description The certificate to be signed, of the same file: the same bytes for the same certificate.
         */
        get: operations["get_calibration_certificate_pdf"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibration/wheel/roll-out": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Roll Out Wheel
         * @description The circumference from rolls on the ground, with its uncertainty, beside the unit's.
         */
        post: operations["roll_out_wheel"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibration/wheel/track": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Track Wheel
         * @description The circumference from the positions of a ride against the turns of its wheel; refused by
         *     name where the rides cannot tell.
         */
        post: operations["track_wheel"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibration/wheel/pulses": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Count Wheel Pulses
         * @description The speed sensor's pulses in a turn of its wheel, from a ride of a wheel turned by hand.
         */
        post: operations["count_wheel_pulses"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibration/cadence": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Check Cadence
         * @description The cadence of a ride against the turns of its crank, counted by the crank's angle.
         */
        post: operations["check_cadence"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/calibration/climb": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Check By Climb
         * @description The torque gain from the energy of a climb, which shares nothing with masses on a pedal;
         *     refused by name where the rides cannot tell.
         */
        post: operations["check_by_climb"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/devices/{device_id}/sensor-drift": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Sensor Drift
         * @description The zero of every ride of this unit while coasting, its trend with temperature and age, and
         *     when it reaches the levels. Also of a unit that is away.
         */
        get: operations["sensor_drift"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/surface": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Compute Surface
         * @description The gain over a grid of speeds and torque rates, by the unit's own C law.
         */
        post: operations["compute_surface"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/surface/points": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Compute Points
         * @description The gain at single points, by the unit's own C law.
         */
        post: operations["compute_points"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/surface/torque": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Compute Torque Surface
         * @description What a steady push gets of a table for long, as motor, battery and market leave it.
         */
        post: operations["compute_torque_surface"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/modes/curves": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Compute Mode Curves
         * @description What each of the five modes gives for a steady push, by the unit's own C law.
         */
        post: operations["compute_mode_curves"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/lint": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Lint Table
         * @description What is wrong, doubtful or notable about a table before a rider finds out.
         */
        post: operations["lint_table"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/certificates": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Prove Limits
         * @description What is proven of every ride with a configuration, against the law of its market.
         */
        post: operations["prove_limits"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/why": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Why Steady
         * @description Why the law gives what it gives in a steady state, on the law's defaults and these.
         */
        post: operations["why_steady"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/library": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Library
         * @description Every table and configuration there is under a name, without its values.
         */
        get: operations["list_library"];
        put?: never;
        /**
         * Add Library Item
         * @description Keeps a document under its name. It is checked as a unit would; nothing goes to a unit.
         */
        post: operations["add_library_item"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/library/compare": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Compare
         * @description Any two side by side: presets, own items, what a unit has or had, a draft. Changes nothing.
         *
         *     The cells and parameters that differ, the surfaces with their largest difference and its place,
         *     and how both feel.
         */
        post: operations["compare"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/library/fis": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Read Fis
         * @description The table in a `.fis` file, with the largest difference between the file and the unit. What
         *     the unit cannot do is refused with its line. Nothing is kept.
         */
        post: operations["read_fis"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/library/{entry_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Library Entry
         * @description One of them whole, as the file that `spindle device restore` takes.
         */
        get: operations["get_library_entry"];
        /**
         * Change Library Item
         * @description Gives an own item another content or name; brings a deleted one back. What it was stays among
         *     its versions.
         */
        put: operations["change_library_item"];
        post?: never;
        /**
         * Remove Library Item
         * @description Takes an own item out of the library. Its versions stay, and a PUT brings it back.
         */
        delete: operations["remove_library_item"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/library/{entry_id}/export": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Export Library Entry
         * @description A file: the document as JSON, or one table for MATLAB and others, or for a spreadsheet.
         */
        get: operations["export_library_entry"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/library/{entry_id}/feel": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Library Feel
         * @description How an entry feels on the simulated bike: an eighth of a second, once for what it holds.
         */
        get: operations["get_library_feel"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/library/{entry_id}/versions": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Library Versions
         * @description Every state an own item was in, newest first: who made it, and when.
         */
        get: operations["list_library_versions"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/home": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Rider Home
         * @description Weeks, months, records and faults of all rides or a bike's; days begin at the zone's
         *     midnight, whatever its clocks do. 422 `unknown_zone` for a zone that is none.
         */
        get: operations["rider_home"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/archive": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Export Rides
         * @description Rides as a ZIP with an `index.csv` that lists them and what could not be made of them.
         */
        get: operations["export_rides"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/tags": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Tag Rides
         * @description Adds tags to rides and takes others from them, all or none.
         */
        post: operations["tag_rides"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/delete": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Delete Rides
         * @description Deletes rides as `delete_ride` does each, in order. One that is gone already is passed over;
         *     409 at one that is being recorded, behind which nothing was deleted.
         */
        post: operations["delete_rides"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/compare": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Compare Rides
         * @description Figures of both with their differences, whether they went the same way, and by which settings
         *     they were ridden.
         */
        get: operations["compare_rides"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/compare/series": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Compare Ride Series
         * @description Both on one axis from the starts of their windows; without channels, those that both have.
         */
        get: operations["compare_ride_series"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/compare/crank": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Compare Ride Crank
         * @description Torque over the crank's angle of both.
         */
        get: operations["compare_ride_crank"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/energy": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Energy Of Ride
         * @description Rider, motor and battery apart: of the whole ride, by mode and by gradient; charge and
         *     range.
         */
        get: operations["energy_of_ride"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/effort": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Effort Of Ride
         * @description Time in zones and bands, and best mean powers. Without a threshold there are no zones.
         */
        get: operations["effort_of_ride"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/pedalling": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Pedalling Of Ride
         * @description Torque over the crank's angle with leg, dead spot and lag; time over speed and gain.
         */
        get: operations["pedalling_of_ride"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/diagnosis": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Diagnosis Of Ride
         * @description What the ride shows of the bike's health, with the evidence; and what it cannot show.
         */
        get: operations["diagnosis_of_ride"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/report": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Report Of Ride
         * @description The ride as one HTML file that needs nothing else: figures, track, traces, energy, zones,
         *     torque round the crank, health. It tells where the ride went, to its ends.
         */
        get: operations["report_of_ride"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Rides
         * @description Newest first; `next` is the cursor of the following page, or null.
         */
        get: operations["list_rides"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Ride
         * @description One ride with its summary, its gaps and its channels.
         */
        get: operations["get_ride"];
        put?: never;
        post?: never;
        /**
         * Delete Ride
         * @description Deletes a ride and its samples; with the last ride that came from a file, the file too.
         */
        delete: operations["delete_ride"];
        options?: never;
        head?: never;
        /**
         * Patch Ride
         * @description Changes name, notes, tags and what is accepted; nothing that was measured.
         */
        patch: operations["patch_ride"];
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/series": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Ride Series
         * @description The exact least and greatest value per pixel; every sample once they fit.
         */
        get: operations["get_ride_series"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/track": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Ride Track
         * @description Where the ride went: some 2000 of its rows, enough to draw its track.
         */
        get: operations["get_ride_track"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/figure": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Ride Figure
         * @description The traces of a ride as a Plotly figure, its titles in a language.
         */
        get: operations["get_ride_figure"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/export": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Export Ride
         * @description The ride as a file, verified before its first byte; `original` is what was uploaded.
         */
        get: operations["export_ride"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/replay": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Replay Ride
         * @description Runs the ride's inputs through the unit's own law with other settings; speed and legs are as
         *     recorded, the bike does not answer.
         */
        post: operations["replay_ride"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/again": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Ride Again
         * @description The same road again with other settings, by a twin of the bike; 422 says why where that
         *     cannot be trusted. Takes a second for some minutes of road, and ends when nobody waits.
         */
        post: operations["ride_again"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/why": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Why Of Ride
         * @description Why the motor gave what it gave then; 409 `no_table` without the ride's configuration.
         */
        get: operations["why_of_ride"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/cuts": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Cuts Of Ride
         * @description Where a limit held the motor back, in order of time, as the unit told it.
         */
        get: operations["cuts_of_ride"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/{ride_id}/ledger": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Ledger Of Ride
         * @description Which mode and which rule carried which share of the ride's motor energy.
         */
        get: operations["ledger_of_ride"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/table-use": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Table Use
         * @description Where in a fuzzy table rides were: seconds and motor energy of each cell.
         */
        post: operations["table_use"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/proposals": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Propose
         * @description Begins to look for settings; nothing is written to any unit.
         */
        post: operations["propose"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/proposals/{proposal_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Proposal
         * @description How far it is, and what was found.
         */
        get: operations["get_proposal"];
        put?: never;
        post?: never;
        /**
         * Cancel Proposal
         * @description Gives it up; one that is over stays as it is.
         */
        delete: operations["cancel_proposal"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/import": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Import Ride
         * @description A whole file as the request's body; answers when it has become a ride or been refused.
         */
        post: operations["import_ride"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/rides/sample": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Make Sample Ride
         * @description A sample ride, simulated and named so; the existing one, if there is one.
         */
        post: operations["sample_ride"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/uploads": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Uploads
         * @description Every file that came, the latest first: also those that were refused and can be removed.
         *
         *     Those within a container are listed with `part_of`, its upload. With `sha256` only files of
         *     these bytes: whether one is here already is known before it is sent, and one of which they are
         *     declared goes on where it stands.
         *
         *     A key that sees no rides is shown what it sent itself.
         */
        get: operations["list_uploads"];
        put?: never;
        /**
         * Create Upload
         * @description Begins an upload; a body with the tus chunk type is its first part already.
         *
         *     `Upload-Metadata` may name the file (`filename`), and say what the whole of it hashes to
         *     (`sha256`, 64 hexadecimal digits): what arrives otherwise is rejected as `hash_mismatch`.
         */
        post: operations["create_upload"];
        delete?: never;
        /**
         * Describe Uploads
         * @description Which version and extensions of tus this server speaks, and how large a file may be.
         */
        options: operations["describe_uploads"];
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/uploads/{upload_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Upload
         * @description Where a file stands, and which rides it became.
         */
        get: operations["get_upload"];
        put?: never;
        post?: never;
        /**
         * Delete Upload
         * @description Removes an upload that no ride came from, and its bytes: unfinished, rejected or a copy.
         *
         *     An original lives as long as a ride that came from it: 409 names these rides, and the file goes
         *     with the last of them. One that is being read is 409 `being_read` until then; one that only
         *     waits for its turn goes, and whoever sent it and waits is told 404. Uploads without rides also
         *     go by themselves when their time is over.
         */
        delete: operations["delete_upload"];
        options?: never;
        /**
         * Get Upload Offset
         * @description How many bytes have arrived: where to go on after a break.
         */
        head: operations["get_upload_offset"];
        /**
         * Append Upload
         * @description The next part of a file. What arrived before a break is kept.
         *
         *     422 with the upload's code when its first 4 KiB are of no ride: the rest need not be sent.
         */
        patch: operations["append_upload"];
        trace?: never;
    };
    "/api/v1/uploads/{upload_id}/mapping": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Mapping
         * @description What can be said of a table, with its first rows; of one that was rejected with
         *     `needs_mapping`, what must be.
         */
        get: operations["get_mapping"];
        /**
         * Put Mapping
         * @description Says it; the file is read, as is every other that waits for the same answer.
         *
         *     Rides that are here already become what their file says now; names, notes and tags stay.
         */
        put: operations["put_mapping"];
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tables": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Tables
         * @description What was said of which tables, by the hash of their header.
         */
        get: operations["list_tables"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tables/{header_sha256}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /**
         * Forget Table
         * @description Forgets what was said: the next file with this header is asked about again.
         */
        delete: operations["forget_table"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/healthz": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Healthz
         * @description The process answers. Says nothing of disk or units; `/api/v1/health` does.
         */
        get: operations["get_healthz"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/readyz": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Readyz
         * @description Requests can be answered; 503 while the database does not answer.
         */
        get: operations["get_readyz"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
}
export type webhooks = Record<string, never>;
export interface components {
    schemas: {
        /**
         * Action
         * @description What was done. It begins with what it was done to.
         * @enum {string}
         */
        Action: "account_added" | "account_first_added" | "account_changed" | "account_password_set" | "account_passkey_added" | "account_passkey_removed" | "account_removed" | "account_signed_in" | "account_signed_out_everywhere" | "key_added" | "key_revoked" | "bike_added" | "bike_changed" | "bike_unit_changed" | "bike_removed" | "bike_offered" | "bike_taken" | "bike_left" | "bike_rides_given" | "unit_first_seen" | "unit_connected" | "unit_named" | "unit_removed" | "unit_faults_cleared" | "unit_log_erased" | "unit_values_tried" | "unit_values_ended" | "configuration_found" | "configuration_written" | "configuration_tried" | "configuration_confirmed" | "configuration_rolled_back" | "calibration_opened" | "calibration_written" | "calibration_restored" | "calibration_closed" | "visit_opened" | "visit_closed" | "visit_consented" | "visit_removed" | "visit_brought" | "ride_changed" | "ride_deleted" | "upload_deleted" | "table_answered" | "table_forgotten" | "library_item_added" | "library_item_changed" | "library_item_removed" | "store_backed_up" | "store_rebuilt";
        /** Address */
        Address: {
            /**
             * Url
             * @description With a slash at its end.
             */
            url: string;
            /**
             * Qr
             * @description It as a QR code: a `data:` address of an SVG.
             */
            qr: string;
        };
        /** Addresses */
        Addresses: {
            /**
             * Addresses
             * @description The one that was called first; none while only this machine reaches the server.
             */
            addresses: components["schemas"]["Address"][];
            /** @description Null where this server does not speak TLS itself. */
            certificate: components["schemas"]["CertificateSeen"] | null;
        };
        /** AgainRequest */
        AgainRequest: {
            /**
             * Parameters
             * @description By registry name, as a unit's configuration or an entry of the library has them. Those of sensor, wheel and drivetrain stay as they were on the ride.
             */
            parameters?: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
            fuzzy_table?: components["schemas"]["FuzzyTable"] | null;
            /** @description Shares speed and torque-rate points with the first. */
            second_table?: components["schemas"]["FuzzyTable"] | null;
            assist_modes?: components["schemas"]["AssistModes"] | null;
            /**
             * Mass Kg
             * @description Rider, bike and load. Without it 92 kg, and a wider band.
             */
            mass_kg?: number | null;
            /**
             * Drag Area M2
             * @description Drag coefficient times frontal area; 0.4 bent low to 0.6 upright. Without it 0.5, and a wider band.
             */
            drag_area_m2?: number | null;
        };
        /** Alive */
        Alive: {
            /**
             * Status
             * @default ok
             * @constant
             */
            status: "ok";
        };
        /**
         * AmongModel
         * @description Against the median of the model's units. deviations: how many of their robust standard
         *     deviations the gain is away; None if they are all alike.
         */
        AmongModel: {
            /** Units */
            units: number;
            /** Gain Pct */
            gain_pct: number;
            /** Deviations */
            deviations: number | null;
        };
        /**
         * AnsweredTable
         * @description A kind of table that was answered for.
         */
        AnsweredTable: {
            /** Header Sha256 */
            header_sha256: string;
            /** Kind */
            kind: string;
            /**
             * Columns
             * @description Their names.
             */
            columns: string[];
            answer: components["schemas"]["TableAnswer"];
        };
        /** AnsweredTables */
        AnsweredTables: {
            /** Items */
            items: components["schemas"]["AnsweredTable"][];
        };
        /**
         * ApiKey
         * @description A key, without its secret.
         */
        ApiKey: {
            /** Id */
            id: number;
            /** Person Id */
            person_id: number;
            /** Person Name */
            person_name: string;
            /** Name */
            name: string;
            /**
             * Prefix
             * @description Its beginning, which is no secret: `sp_` and this.
             */
            prefix: string;
            /** Scopes */
            scopes: components["schemas"]["Permission"][];
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /** Expires At */
            expires_at: string | null;
            /**
             * Used At
             * @description When last, to a minute.
             */
            used_at: string | null;
            /** Revoked At */
            revoked_at: string | null;
            /**
             * Bike Id
             * @description The one bike it is for; null for all.
             */
            bike_id: number | null;
            /** Bike Name */
            bike_name: string | null;
        };
        /** ApiKeyIn */
        ApiKeyIn: {
            /** Name */
            name: string;
            /**
             * Scopes
             * @description What it is for; it never allows more than its person's role.
             */
            scopes: components["schemas"]["Permission"][];
            /**
             * Person Id
             * @description Whose it is; of who asks if null.
             */
            person_id?: number | null;
            /**
             * Expires At
             * @description Never if null.
             */
            expires_at?: string | null;
            /**
             * Bike Id
             * @description The one bike it sends files of, with `upload_files` as its only scope.
             */
            bike_id?: number | null;
        };
        /** ApiKeys */
        ApiKeys: {
            /** Items */
            items: components["schemas"]["ApiKey"][];
        };
        /**
         * AssistMode
         * @description One of the five slots the rider's switch selects.
         */
        AssistMode: {
            /** Name */
            name: string;
            /**
             * Law
             * @enum {string}
             */
            law: "off" | "fixed" | "fuzzy";
            /** Ratio */
            ratio: number;
            /**
             * Taper
             * @description How the fixed law's ratio falls with speed.
             * @default taper_speeds
             * @enum {string}
             */
            taper: "taper_speeds" | "none" | "japan_1_to_1" | "japan_2_to_1";
            /**
             * Table
             * @description Which of the two fuzzy tables.
             * @default first
             * @enum {string}
             */
            table: "first" | "second";
            /**
             * Ramp Up Nm Per S
             * @default 2000
             */
            ramp_up_nm_per_s: number;
            /**
             * Ramp Down Nm Per S
             * @default 2000
             */
            ramp_down_nm_per_s: number;
            /**
             * Torque Pct
             * @description Of the unit's largest motor torque.
             * @default 100
             */
            torque_pct: number;
        };
        /** AssistModes */
        AssistModes: {
            /** Modes */
            modes: components["schemas"]["AssistMode"][];
            /** Mode At Start */
            mode_at_start: number;
        };
        /**
         * Asymmetry
         * @description left_right: (right - left) / mean of the slopes; bending in the plane of the crank looks the
         *     same and is within. bending_across: what a crank that points down would read of its load; None
         *     without captures over enough of the crank's angle on both sides.
         */
        Asymmetry: {
            left_right: components["schemas"]["LoadShare"];
            bending_across?: components["schemas"]["LoadShare"] | null;
        };
        /**
         * AuditEvent
         * @description One change: who made it, when, to what, and what was otherwise before.
         */
        AuditEvent: {
            /**
             * Id
             * @description Counts from 1 without a gap.
             */
            id: number;
            /**
             * At
             * Format: date-time
             */
            at: string;
            /**
             * Actor Kind
             * @description A `person`, a program with a `key`, the `server` by itself, a `command` on its folder.
             * @enum {string}
             */
            actor_kind: "person" | "key" | "server" | "command";
            /**
             * Actor Name
             * @description Of the account then; where nobody signs in, as the request states it; empty for nobody.
             */
            actor_name: string;
            /**
             * Person Id
             * @description Null where nobody signed in.
             */
            person_id: number | null;
            /** Key Name */
            key_name: string | null;
            action: components["schemas"]["Action"];
            /**
             * Object Kind
             * @enum {string}
             */
            object_kind: "account" | "key" | "bike" | "unit" | "configuration" | "calibration" | "visit" | "ride" | "upload" | "table" | "library_item" | "store";
            /** Object Id */
            object_id: string | null;
            /**
             * Object Name
             * @description As it was called then.
             */
            object_name: string | null;
            /** Unit Key */
            unit_key: string | null;
            /** Bike Id */
            bike_id: number | null;
            /**
             * Bike Name
             * @description As it is called now; null once it is removed.
             */
            bike_name: string | null;
            /**
             * Before
             * @description What differs, by name; physical names carry their units.
             */
            before: {
                [key: string]: unknown;
            } | null;
            /** After */
            after: {
                [key: string]: unknown;
            } | null;
            /** Reason */
            reason: string | null;
            /**
             * Sha256
             * @description Of this event and of all before it; `spindle audit verify --expect` finds it again.
             */
            sha256: string;
        };
        /** AuditPage */
        AuditPage: {
            /** Items */
            items: components["schemas"]["AuditEvent"][];
            /**
             * Next
             * @description The cursor of the following page.
             */
            next: string | null;
        };
        /**
         * AxisGap
         * @description A stretch without samples; one in which the bike stood has no length on the way.
         */
        AxisGap: {
            /** From X */
            from_x: number;
            /** To X */
            to_x: number;
        };
        /**
         * Balance
         * @description gain_ratio: true torque over told torque. crank_energy_j: by the torque as told.
         *     motor_energy_j: what the motor gave; None where nobody measured it. needed_energy_j: on the
         *     road, without the drivetrain's loss. contributions: standard, of the ratio. expanded: k = 2.
         *     en: the distance from 1 in both uncertainties. agrees: it is 1 or less.
         */
        Balance: {
            /** Gain Ratio */
            gain_ratio: number;
            /** Crank Energy J */
            crank_energy_j: number;
            /** Motor Energy J */
            motor_energy_j: number | null;
            /** Needed Energy J */
            needed_energy_j: number;
            needed: components["schemas"]["Needed"];
            /** Contributions */
            contributions: {
                [key: string]: number;
            };
            /** Expanded */
            expanded: number;
            /** En */
            en: number;
            /** Agrees */
            agrees: boolean;
            /** Sentence */
            sentence: string;
        };
        /**
         * Band
         * @description Time from `low` up to `high`; null for no end.
         */
        Band: {
            /** Low */
            low: number | null;
            /** High */
            high: number | null;
            /** Seconds */
            seconds: number;
        };
        /**
         * BandPoint
         * @description The zero at the typical temperature, with its interval of 90 %.
         */
        BandPoint: {
            /**
             * At
             * Format: date-time
             */
            at: string;
            /** Zero Nm */
            zero_nm: number;
            /** Low Nm */
            low_nm: number;
            /** High Nm */
            high_nm: number;
        };
        /**
         * BestMean
         * @description The greatest mean over this long, in the stretch that begins at `from_s`.
         */
        BestMean: {
            /** Duration S */
            duration_s: number;
            /** Power W */
            power_w: number;
            /** From S */
            from_s: number;
        };
        /**
         * Bike
         * @description A bike of the register. Null is what nobody said and no unit reported.
         */
        Bike: {
            /** Id */
            id: number;
            /** Name */
            name: string;
            /** Model */
            model: string | null;
            /** Frame Number */
            frame_number: string | null;
            /** Battery */
            battery: string | null;
            /**
             * Mileage Km
             * @description As its counter showed it when somebody last read it.
             */
            mileage_km: number | null;
            /** Mileage At */
            mileage_at: string | null;
            /**
             * Lost At
             * @description Reported as lost or stolen.
             */
            lost_at: string | null;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            unit: components["schemas"]["BikeUnit"] | null;
            /**
             * Market
             * @description By the unit's last configuration that is known here.
             */
            market: string | null;
            /** Wheel Circumference M */
            wheel_circumference_m: number | null;
            owner: components["schemas"]["BikeOwner"] | null;
            /**
             * Rides
             * @description That the caller may see.
             */
            rides: number;
            /** Distance Km */
            distance_km: number | null;
            /** Last Ride At */
            last_ride_at: string | null;
        };
        /**
         * BikeChange
         * @description What is absent stays; null takes away what was said. An owner changes name and `lost`.
         */
        BikeChange: {
            /** Name */
            name?: string | null;
            /** Model */
            model?: string | null;
            /** Frame Number */
            frame_number?: string | null;
            /** Battery */
            battery?: string | null;
            /** Mileage Km */
            mileage_km?: number | null;
            /** Lost */
            lost?: boolean | null;
            /**
             * Unit Key
             * @description The drive unit that is on it now; it leaves the bike it was on. Null: none.
             */
            unit_key?: string | null;
        };
        /**
         * BikeDetail
         * @description A bike and, for the workshop, everybody who had it, the last first.
         */
        BikeDetail: {
            bike: components["schemas"]["Bike"];
            /** Owners */
            owners: components["schemas"]["BikeOwner"][];
        };
        /**
         * BikeGift
         * @description Which rides were made with a bike.
         */
        BikeGift: {
            /** Ride Ids */
            ride_ids: number[];
        };
        /**
         * BikeIn
         * @description A bike without a unit.
         */
        BikeIn: {
            /** Name */
            name: string;
            /** Model */
            model?: string | null;
            /** Frame Number */
            frame_number?: string | null;
            /** Battery */
            battery?: string | null;
            /** Mileage Km */
            mileage_km?: number | null;
        };
        /**
         * BikeOwner
         * @description Whose a bike is or was.
         */
        BikeOwner: {
            /**
             * Person Id
             * @description Null once the account was removed.
             */
            person_id: number | null;
            /** Name */
            name: string;
            /**
             * Since
             * Format: date-time
             */
            since: string;
            /**
             * Until
             * @description Null while it is theirs.
             */
            until: string | null;
        };
        /**
         * BikeTotals
         * @description A bike that was ridden.
         */
        BikeTotals: {
            /** Bike Id */
            bike_id: number;
            /** Name */
            name: string;
            /**
             * Last Ride At
             * Format: date-time
             */
            last_ride_at: string;
            /** Rides */
            rides: number;
            /** Distance Km */
            distance_km: number | null;
        };
        /**
         * BikeUnit
         * @description The drive unit on a bike.
         */
        BikeUnit: {
            /** Key */
            key: string;
            /** Model */
            model: string | null;
            /** Serial Number */
            serial_number: string | null;
            /** Firmware Version */
            firmware_version: string | null;
            /**
             * Last Seen At
             * Format: date-time
             */
            last_seen_at: string;
        };
        /** Bikes */
        Bikes: {
            /** Items */
            items: components["schemas"]["Bike"][];
        };
        /** BinExtremes */
        BinExtremes: {
            /** Min */
            min: (number | null)[];
            /** Max */
            max: (number | null)[];
        };
        /**
         * Budget
         * @description Over torque_nm (k,). coverage: the factor at each, 2 or more; expanded = coverage x combined,
         *     for 95.45 %.
         */
        Budget: {
            /** Torque Nm */
            torque_nm: number[];
            /** Contributions */
            contributions: components["schemas"]["Contribution"][];
            /** Combined Nm */
            combined_nm: number[];
            /** Degrees Of Freedom */
            degrees_of_freedom: (number | null)[];
            /** Coverage */
            coverage: number[];
            /** Expanded Nm */
            expanded_nm: number[];
        };
        /**
         * Cadence
         * @description The mean cadence that the unit reported, against the turns of its crank's angle.
         */
        Cadence: {
            /** Reported Rpm */
            reported_rpm: number;
            /** Turns */
            turns: number;
            /** Duration S */
            duration_s: number;
            /**
             * Error Rpm
             * @description Reported less counted.
             */
            error_rpm: number;
            /**
             * Expanded Rpm
             * @description Expanded uncertainty of the counting, k = 2.
             */
            expanded_rpm: number;
            /** Agrees */
            agrees: boolean;
        };
        /**
         * CadenceRequest
         * @description A part of a ride; at best from a standing crank to a standing one.
         */
        CadenceRequest: {
            /** Ride Id */
            ride_id: number;
            /** From S */
            from_s?: number | null;
            /** To S */
            to_s?: number | null;
        };
        /**
         * CalibratedTorque
         * @description How well the calibration knows the torque, and who says so.
         *
         *     `unknown`: only the climb's uncertainty counts.
         */
        CalibratedTorque: {
            /**
             * Source
             * @enum {string}
             */
            source: "given" | "certificate" | "unknown";
            /** Expanded Share */
            expanded_share: number;
            certificate: components["schemas"]["CertificateOfTorque"] | null;
        };
        /**
         * Calibration
         * @description How raw counts become newton metres, and how they are filtered.
         *
         *     What has a default may be missing in what is written.
         */
        Calibration: {
            /** Sensor Offset Counts */
            sensor_offset_counts: number;
            /** Sensor Gain Nm Per Count */
            sensor_gain_nm_per_count: number;
            /**
             * Sensor Offset Counts Per K
             * @description For each kelvin above `sensor_reference_degc`; null: not corrected.
             */
            sensor_offset_counts_per_k?: number | null;
            /**
             * Sensor Gain Share Per K
             * @description For each kelvin above `sensor_reference_degc`; null: not corrected.
             */
            sensor_gain_share_per_k?: number | null;
            /**
             * Sensor Reference Degc
             * @description Null: nothing is corrected for temperature.
             */
            sensor_reference_degc?: number | null;
            /**
             * Calibrated At Utc S
             * @description Seconds since 1970; 0 where it is not known.
             */
            calibrated_at_utc_s?: number | null;
            /**
             * Calibration Number
             * @description 0: the factory's.
             */
            calibration_number?: number | null;
            /**
             * Calibration Certificate
             * @description First 8 bytes of its SHA-256; all 0 where there is none.
             */
            calibration_certificate?: number[] | null;
            /**
             * Torque Filter
             * @description Averages with `torque_filter_s`, or over the last half turn of the crank.
             */
            torque_filter?: ("time_constant" | "half_turn") | null;
            /** Torque Filter S */
            torque_filter_s: number;
            /** Torque Rate Interval Ms */
            torque_rate_interval_ms: number;
            /** Torque Rate Floor Nm */
            torque_rate_floor_nm: number;
            /**
             * Sensor Offset Counts Factory
             * @description What the factory measured: within 5 Nm of it `sensor_offset_counts` needs no token. Told by the unit; not looked at when it is written.
             */
            readonly sensor_offset_counts_factory?: number | null;
            /**
             * Sensor Gain Nm Per Count Factory
             * @description What the factory measured: within 15 % of it `sensor_gain_nm_per_count` needs no token. Told by the unit; not looked at when it is written.
             */
            readonly sensor_gain_nm_per_count_factory?: number | null;
        };
        /**
         * CalibrationMark
         * @description A configuration that changed how counts become torque.
         */
        CalibrationMark: {
            /** Seq */
            seq: number;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /** Author */
            author: string;
            /** Reason */
            reason: string;
            /** Changed */
            changed: components["schemas"]["ScaleChange"][];
        };
        /**
         * Capability
         * @description What units differ in; the API and the pages use these words.
         *
         *     unit_trial: the unit itself returns from a change that is not kept. live_set: values can be on
         *     trial in its memory alone. unlock: its maker may permit what its market forbids. unit_limits: it
         *     enforces limits by itself. unique_id: it has a serial number. restart_to_apply: what is written
         *     holds from the next start on.
         * @enum {string}
         */
        Capability: "read_config" | "write_config" | "unit_trial" | "stream" | "rider_torque" | "calibrate" | "live_set" | "logs" | "unlock" | "unit_limits" | "unique_id" | "restart_to_apply" | "fuzzy_table" | "assist_modes" | "limits" | "simulation";
        /**
         * CaptureRequest
         * @description What hangs there now. The sensor's temperature is the unit's to tell.
         */
        CaptureRequest: {
            /**
             * Kind
             * @enum {string}
             */
            kind: "zero" | "load";
            /** Side */
            side?: ("left" | "right") | null;
            /**
             * Mass Kg
             * @default 0
             */
            mass_kg: number;
            /**
             * Arm M
             * @description The setup's if null.
             */
            arm_m?: number | null;
            /**
             * Crank Angle Deg
             * @description 0: the crank level and forward; positive: pedal going down.
             * @default 0
             */
            crank_angle_deg: number;
            /**
             * Stroke
             * @default 1
             */
            stroke: number;
            /** Direction */
            direction?: ("loading" | "unloading") | null;
            /**
             * Pedals Free
             * @description Somebody looked: nothing is on the pedals, although the unit tells of a foot.
             * @default false
             */
            pedals_free: boolean;
        };
        /**
         * CaptureSummary
         * @description One capture, without its raw counts, which the certificate has.
         */
        CaptureSummary: {
            /** Number */
            number: number;
            state: components["schemas"]["State"];
            /**
             * Load Nm
             * @description As of the setup now.
             */
            load_nm: number;
            /** Mean Counts */
            mean_counts: number;
            /** Deviation Counts */
            deviation_counts: number;
            /** Count */
            count: number;
            /**
             * Rejected
             * @description Samples left out as outliers.
             */
            rejected: number;
            /** Duration S */
            duration_s: number;
            /**
             * At
             * Format: date-time
             */
            at: string;
            /**
             * Found Nm
             * @description By the coefficients that the unit had.
             */
            found_nm: number | null;
            /**
             * Fitted Nm
             * @description By those of the fit.
             */
            fitted_nm: number | null;
            /**
             * Unit Nm
             * @description What the unit itself told then.
             */
            unit_nm: number | null;
            struck: components["schemas"]["Struck"] | null;
            /**
             * Refusals
             * @description Those that name this capture.
             */
            refusals: components["schemas"]["Refusal"][];
        };
        /**
         * Cause
         * @description Why it is no pass, or what else to know (`note`). figure, allowed, expanded: percent, where
         *     there are such numbers.
         */
        Cause: {
            /** Code */
            code: string;
            /**
             * Weight
             * @enum {string}
             */
            weight: "note" | "conditional" | "fail";
            /** Sentence */
            sentence: string;
            /** Figure */
            figure?: number | null;
            /** Allowed */
            allowed?: number | null;
            /** Expanded */
            expanded?: number | null;
        };
        /**
         * Cell
         * @description Between two speed points: the assist per rider torque that any mode asks for at most, and
         *     what the market allows there at least.
         */
        Cell: {
            /** From Kmh */
            from_kmh: number;
            /** To Kmh */
            to_kmh: number;
            /** Ratio Most */
            ratio_most: number;
            /** Allowed Ratio */
            allowed_ratio: number | null;
        };
        /**
         * CellChange
         * @description A rule with another label. row: of the speed; column: of the torque rate.
         */
        CellChange: {
            /**
             * Row
             * @description Of the speed, from 0.
             */
            row: number;
            /**
             * Column
             * @description Of the torque rate, from 0.
             */
            column: number;
            /**
             * Left
             * @enum {string}
             */
            left: "NB" | "NS" | "ZO" | "PS" | "PB";
            /**
             * Right
             * @enum {string}
             */
            right: "NB" | "NS" | "ZO" | "PS" | "PB";
        };
        /**
         * CertificateFile
         * @description What `spindle calibrate evaluate` reads; docs/calibration.md says what is in it.
         */
        CertificateFile: {
            /** Document */
            document: {
                [key: string]: unknown;
            } | null;
            /** Sha256 */
            sha256?: string | null;
            /** Written */
            written?: {
                [key: string]: unknown;
            } | null;
            /** Job */
            job?: {
                [key: string]: unknown;
            } | null;
        };
        /** CertificateOfTorque */
        CertificateOfTorque: {
            /**
             * Calibration Id
             * @description Of the job that has it.
             */
            calibration_id: number;
            /**
             * Sha256
             * @description Of the certificate that the unit keeps.
             */
            sha256: string;
            /**
             * Written At
             * Format: date-time
             * @description When the unit got it.
             */
            written_at: string;
            /**
             * Torque Nm
             * @description The mean of the climb.
             */
            torque_nm: number;
            /**
             * Expanded Share
             * @description Of that torque, k = 2.
             */
            expanded_share: number;
        };
        /** CertificateSeen */
        CertificateSeen: {
            /**
             * Sha256
             * @description Of the certificate, in pairs of hexadecimal digits, as browsers show it.
             */
            sha256: string;
            /**
             * Ends At
             * Format: date-time
             */
            ends_at: string;
            /**
             * Is Own
             * @description Whether this server made it, so that a browser warns of it.
             */
            is_own: boolean;
        };
        /**
         * Change
         * @description Since the last one of this bike. *_en: the change in its expanded uncertainty; above 1 the
         *     sensor has changed.
         */
        Change: {
            /** Days */
            days: number;
            /** Offset Nm */
            offset_nm: number;
            /** Offset En */
            offset_en: number;
            /** Gain Pct */
            gain_pct: number;
            /** Gain En */
            gain_en: number;
        };
        /**
         * Charge
         * @description What was used of the charge, and how far the rest goes on a ride like this one.
         *
         *     The estimate says nothing of another road, wind or mode.
         */
        Charge: {
            /** Soc Pct First */
            soc_pct_first: number;
            /** Soc Pct Last */
            soc_pct_last: number;
            /**
             * Used Pct
             * @description What it fell by, summed up: more than a full charge where the battery was changed.
             */
            used_pct: number;
            /** Jumps */
            jumps: components["schemas"]["ChargeJump"][];
            /**
             * Step Pct
             * @description The finest change that the reading shows.
             */
            step_pct: number;
            /**
             * Range Km
             * @description With the charge left at the end.
             */
            range_km: number | null;
            /** Range Km Least */
            range_km_least: number | null;
            /**
             * Range Km Most
             * @description Null where the leanest third of the distance took nothing.
             */
            range_km_most: number | null;
            /**
             * Full Range Km
             * @description Of a whole charge on a ride like this one.
             */
            full_range_km: number | null;
            /**
             * Refused
             * @description Why there is no range.
             */
            refused: ("no_distance" | "short_way" | "charged" | "little_used") | null;
        };
        /**
         * ChargeJump
         * @description A charge on the way, or another battery.
         */
        ChargeJump: {
            /** At S */
            at_s: number;
            /** From Pct */
            from_pct: number;
            /** To Pct */
            to_pct: number;
        };
        /**
         * Check
         * @description passed: None where nobody could tell. figure, allowed: in the unit the code implies. values:
         *     what the sentence tells besides, by name, for a text in another language.
         */
        Check: {
            /** Code */
            code: string;
            /** Passed */
            passed: boolean | null;
            /** Sentence */
            sentence: string;
            /** Figure */
            figure: number | null;
            /** Allowed */
            allowed: number | null;
            /** Values */
            values?: {
                [key: string]: number | string;
            };
        };
        /**
         * Circumference
         * @description expanded_m: for 95.45 %, coverage its factor. method: `roll_out` or `gps`.
         */
        Circumference: {
            /** Circumference M */
            circumference_m: number;
            /** Standard M */
            standard_m: number;
            /** Coverage */
            coverage: number;
            /** Expanded M */
            expanded_m: number;
            /** Method */
            method: string;
        };
        /**
         * Claim
         * @description A statement about every ride there can be with this configuration.
         */
        Claim: {
            /** Code */
            code: string;
            /** Message */
            message: string;
            /** Unit */
            unit: string;
            /**
             * Bound
             * @description What was proven; null where it does not happen.
             */
            bound: number | null;
            /**
             * Allowed
             * @description What the market asks for; null where it asks for nothing.
             */
            allowed: number | null;
            /**
             * Least
             * @description The market asks for `allowed` or more, not for less.
             */
            least: boolean;
            /**
             * Margin
             * @description From the bound to what is allowed.
             */
            margin: number | null;
            /** Holds */
            holds: boolean;
            /**
             * How
             * @description `structure`: a step of the unit's pipeline that every way goes through. `interval`: bounds over every cell of a table. `recursion`: what filters, ramps and counters can remember.
             * @enum {string}
             */
            how: "structure" | "interval" | "recursion";
            /** Values */
            values: {
                [key: string]: number | string;
            };
        };
        /**
         * Climb
         * @description By heights averaged over 5 m of distance; a climb counts once it is 3 m high.
         */
        Climb: {
            /** Ascent M */
            ascent_m: number;
            /** Descent M */
            descent_m: number;
            /**
             * Lowest M
             * @description Of the averaged heights.
             */
            lowest_m: number;
            /**
             * Highest M
             * @description Of the averaged heights.
             */
            highest_m: number;
        };
        /**
         * ClimbRequest
         * @description A steady climb on the legs alone, and coast-downs with the same rider and tyres; each
         *     `_limit` is a half width.
         */
        ClimbRequest: {
            climb: components["schemas"]["SlopeRidden"];
            /**
             * Coast Downs
             * @description None: rolling and air are typical, within limits.
             * @default []
             */
            coast_downs: components["schemas"]["SlopeRidden"][];
            /**
             * Mass Kg
             * @description Bike, rider and all they carry.
             */
            mass_kg: number;
            /** Mass Limit Kg */
            mass_limit_kg: number;
            /**
             * Gravity
             * @description Null: anything between the equator's and the poles'.
             */
            gravity?: components["schemas"]["GravityAt"] | components["schemas"]["GravityInput"] | null;
            /** Rise Limit M */
            rise_limit_m: number;
            /**
             * Efficiency
             * @description From crank to road.
             * @default 0.97
             */
            efficiency: number;
            /**
             * Efficiency Limit
             * @default 0.015
             */
            efficiency_limit: number;
            /**
             * Wheels Kg
             * @description What their inertia adds.
             * @default 2.2
             */
            wheels_kg: number;
            /**
             * Wheels Limit Kg
             * @default 0.5
             */
            wheels_limit_kg: number;
            /**
             * Speed Share Limit
             * @default 0.005
             */
            speed_share_limit: number;
            /**
             * Wind Limit Ms
             * @default 0.5
             */
            wind_limit_ms: number;
            /**
             * Calibrated Expanded Pct
             * @description Of the torque by its calibration, k = 2; null: by the certificate of the last one that was in the unit before the ride.
             */
            calibrated_expanded_pct?: number | null;
            /**
             * Motor Off
             * @description The rider's word, needed where the ride does not tell what the motor gave.
             * @default false
             */
            motor_off: boolean;
        };
        /**
         * ClimbResult
         * @description The torque gain by an energy balance, and whether it agrees with the calibration.
         */
        ClimbResult: {
            /** Unit Key */
            unit_key: string | null;
            /**
             * Rise M
             * @description Of the climb, as it was counted.
             */
            rise_m: number;
            /** Duration S */
            duration_s: number;
            resistance: components["schemas"]["Resistance"];
            balance: components["schemas"]["Balance"];
            calibrated: components["schemas"]["CalibratedTorque"];
        };
        /**
         * ClockSet
         * @description The host's clock was set while the calibration was open.
         */
        ClockSet: {
            /**
             * At
             * Format: date-time
             */
            at: string;
            /**
             * By S
             * @description Negative for back.
             */
            by_s: number;
            /**
             * Dated
             * @description Dates of before were moved; else they stand: the unit has a certificate of them.
             */
            dated: boolean;
        };
        /**
         * ClosedLoop
         * @description The same road again with other settings: an estimate with its band.
         *
         *     Peak torque and its steepest rise are not reported: they cannot be forecast.
         */
        ClosedLoop: {
            /**
             * Meaning
             * @description What it is and what it leaves out, in English.
             */
            meaning: string;
            /** @description Work at the motor's shaft for a kilometre. */
            wh_per_km: components["schemas"]["Estimate"];
            motor_work_wh: components["schemas"]["Estimate"];
            /** @description What leaves the battery, also at a stand; null where voltage or current was not recorded. */
            battery_wh: components["schemas"]["Estimate"] | null;
            /** @description Range: how far 100 Wh of the battery go on this road. Null as `battery_wh`. */
            km_per_100_wh: components["schemas"]["Estimate"] | null;
            rider_work_wh: components["schemas"]["Estimate"];
            duration_s: components["schemas"]["Estimate"];
            /** @description At the shaft, while the bike moves. */
            motor_power_w_mean: components["schemas"]["Estimate"];
            /** @description Rms of how fast the motor's torque changes, while the bike moves. */
            ripple_nm_per_s: components["schemas"]["Estimate"];
            /**
             * Limits
             * @description Those that were at work, in either ride.
             */
            limits: components["schemas"]["TimeAtLimit"][];
            curves: components["schemas"]["RideCurves"];
            trust: components["schemas"]["Trust"];
        };
        /**
         * Coefficients
         * @description None: no correction of that kind. The unit's law applies the same equation in C.
         *
         *     torque_nm = (raw - offset_counts - offset_counts_per_k dt) gain_nm_per_count
         *                 (1 + gain_share_per_k dt), dt from reference_degc.
         */
        Coefficients: {
            /** Offset Counts */
            offset_counts: number;
            /** Gain Nm Per Count */
            gain_nm_per_count: number;
            /** Offset Counts Per K */
            offset_counts_per_k?: number | null;
            /** Gain Share Per K */
            gain_share_per_k?: number | null;
            /** Reference Degc */
            reference_degc?: number | null;
        };
        /**
         * Common
         * @description One cause that all loads share. shift: of each coefficient in `Fit.names`, for one standard
         *     uncertainty of the cause.
         */
        Common: {
            /** Cause */
            cause: string;
            /** Shift */
            shift: number[];
        };
        /** CompareRequest */
        CompareRequest: {
            left: components["schemas"]["Side"];
            right: components["schemas"]["Side"];
            /**
             * Feel
             * @description Measure both on the simulated bike; a fraction of a second each.
             * @default false
             */
            feel: boolean;
        };
        /** Compared */
        Compared: {
            /** Recorded */
            recorded: number | null;
            /** Replayed */
            replayed: number;
            /** Difference */
            difference: number | null;
        };
        /**
         * ComparedChannel
         * @description A channel under the name of what it is: the torque of a ride that tells only what was asked
         *     of its motor is `motor_torque_demanded_nm`, whatever the file calls it.
         */
        ComparedChannel: {
            /** Name */
            name: string;
            /** Unit */
            unit: string;
            /** A */
            a: boolean;
            /** B */
            b: boolean;
        };
        /**
         * ComparedCrank
         * @description Torque over the crank's angle of both; the motor's only as delivered.
         */
        ComparedCrank: {
            a: components["schemas"]["CrankTorque"] | null;
            b: components["schemas"]["CrankTorque"] | null;
            /** A Refused */
            a_refused: ("no_angle" | "no_torque" | "slow_rows" | "few_turns") | null;
            /** B Refused */
            b_refused: ("no_angle" | "no_torque" | "slow_rows" | "few_turns") | null;
            difference: components["schemas"]["CrankDifference"];
        };
        /** ComparedFigure */
        ComparedFigure: {
            /** Name */
            name: string;
            /** Unit */
            unit: string;
            a: components["schemas"]["FigureValue"];
            b: components["schemas"]["FigureValue"];
            /**
             * Difference
             * @description B less A; null where one is missing.
             */
            difference: number | null;
        };
        /**
         * ComparedSeries
         * @description Both rides in bins of equal length. A bin has the least and greatest value of the rows that
         *     begin in it, else of the row that still holds; in a gap null.
         */
        ComparedSeries: {
            /**
             * By
             * @enum {string}
             */
            by: "time" | "distance";
            /**
             * Unit
             * @enum {string}
             */
            unit: "s" | "m";
            /**
             * End X
             * @description Of the axis: where the longer of both ends.
             */
            end_x: number;
            /**
             * X
             * @description Edges of the bins, one more than there are bins.
             */
            x: number[];
            /** Channels */
            channels: components["schemas"]["SeriesComparison"][];
            /** A Gaps */
            a_gaps: components["schemas"]["AxisGap"][];
            /** B Gaps */
            b_gaps: components["schemas"]["AxisGap"][];
        };
        /**
         * ComparedSide
         * @description A window of a ride; places on an axis count from its start.
         */
        ComparedSide: {
            /** Ride Id */
            ride_id: number;
            /** From S */
            from_s: number;
            /** To S */
            to_s: number;
            /** Rows */
            rows: number;
            /** Motor Torque Meaning */
            motor_torque_meaning: ("demanded" | "delivered") | null;
            /** Length S */
            length_s: number;
            /**
             * Length M
             * @description Null where nothing tells its way.
             */
            length_m: number | null;
        };
        /** Comparison */
        Comparison: {
            left: components["schemas"]["TableReview"];
            right: components["schemas"]["TableReview"];
            /**
             * Parameters
             * @description What differs; of a table beside a configuration what the table has. Null where a side says nothing of it.
             */
            parameters: components["schemas"]["ParameterChange"][];
            /** @description Null where a side has no table. */
            tables: components["schemas"]["TableComparison"] | null;
        };
        /**
         * Config
         * @description A unit's whole configuration; parameters by registry name.
         */
        Config: {
            /**
             * Unit Key
             * @description Of the unit that has it.
             */
            unit_key: string;
            /** Generation */
            generation: number;
            /** Crc32 */
            crc32: number;
            /** Parameters */
            parameters: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
        };
        /**
         * ConfigChange
         * @description A change that the unit took, read back and compared field by field.
         */
        ConfigChange: {
            /**
             * Unit Key
             * @description Of the unit that took it.
             */
            unit_key: string;
            /** Generation */
            generation: number;
            /** Crc32 */
            crc32: number;
            /**
             * State
             * @description `provisional`: given up at `expires_at` unless it is confirmed. `needs_restart`: holds from
             *     the unit's next start on.
             * @enum {string}
             */
            state: "committed" | "provisional" | "needs_restart";
            /**
             * Verified
             * @description Whether the last comparison that this make of unit allows was made.
             */
            verified: boolean;
            /** Changed */
            changed: components["schemas"]["ParameterChange"][];
            /** Expires At */
            expires_at: string | null;
            /**
             * Parameters
             * @description The whole configuration as it was read back.
             */
            parameters: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
        };
        /** ConfigPatch */
        ConfigPatch: {
            /** Parameters */
            parameters: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
            /**
             * Reason
             * @default
             */
            reason: string;
            /**
             * Confirm S
             * @description 0 commits for good; else the unit returns to what it had after so many seconds, at a restart or power loss, unless `POST .../config/confirm` comes first.
             * @default 0
             */
            confirm_s: number;
            /**
             * Token
             * @description The maker's answer to the `challenge` of a refusal `token_needed`.
             */
            token?: string | null;
            /**
             * Read From
             * @description The `unit_key` of the unit that the values were read from, where they come from a backup or a revision. What stays with a unit (`of_the_unit`) is refused of another one, the record of a calibration also where this is not told: 422 `of_another_unit`.
             */
            read_from?: string | null;
        };
        /**
         * ConfigSlot
         * @description One of the two places in the unit's flash its configuration is kept.
         */
        ConfigSlot: {
            /**
             * State
             * @description `unknown`: to this Spindle.
             * @enum {string}
             */
            state: "empty" | "confirmed" | "provisional" | "void" | "damaged" | "unknown";
            /** Generation */
            generation: number;
            /**
             * Erases
             * @description In the unit's life; this wears it.
             */
            erases: number;
            /**
             * Active
             * @description Whether the unit runs on it.
             */
            active: boolean;
        };
        /**
         * ConfigStamp
         * @description Which configuration is active. A provisional one is given up at `expires_at`.
         */
        ConfigStamp: {
            /** Generation */
            generation: number;
            /** Crc32 */
            crc32: number;
            /**
             * State
             * @default committed
             * @enum {string}
             */
            state: "committed" | "provisional";
            /** Expires At */
            expires_at: string | null;
            /**
             * Remaining S
             * @description Until a provisional one is given up.
             */
            remaining_s: number | null;
            /**
             * Rollback Cause
             * @description Why the latest trial was given up; null when none was since the unit's start.
             */
            rollback_cause: ("asked" | "time_out" | "restart" | "unknown") | null;
        };
        /**
         * Contribution
         * @description standard_nm: at each torque of the budget. degrees_of_freedom: None is infinitely many.
         */
        Contribution: {
            /** Cause */
            cause: string;
            /** Standard Nm */
            standard_nm: number[];
            /** Degrees Of Freedom */
            degrees_of_freedom: number | null;
        };
        /**
         * CrankDifference
         * @description B less A, bin by bin; null unless both are known.
         */
        CrankDifference: {
            /** Rider Nm */
            rider_nm: number[] | null;
            /** Motor Nm */
            motor_nm: number[] | null;
        };
        /**
         * CrankTorque
         * @description Means over turning cranks, in 36 bins from the left crank up on.
         */
        CrankTorque: {
            /** Turns */
            turns: number;
            /** Cadence Rpm */
            cadence_rpm: number;
            /** Rider Nm */
            rider_nm: number[];
            /**
             * Motor Nm
             * @description What the motor gave, at the crank.
             */
            motor_nm: number[] | null;
            /**
             * Left Share
             * @description Of the rider's work, in the half of the turn in which the left leg pushes.
             */
            left_share: number | null;
            /** Dead Spot Deg */
            dead_spot_deg: number;
            /**
             * Dead Spot Share
             * @description Its torque over the mean.
             */
            dead_spot_share: number | null;
            /**
             * Lag Deg
             * @description Of the motor behind the rider, by the fundamental of the stroke; null where the motor's torque is not known or does not swing with it.
             */
            lag_deg: number | null;
            /** Lag Ms */
            lag_ms: number | null;
        };
        /**
         * Crossing
         * @description When the zero reaches a level of either sign; the interval is of 90 %.
         */
        Crossing: {
            /** Level Nm */
            level_nm: number;
            /**
             * State
             * @enum {string}
             */
            state: "over" | "expected" | "not_in_sight";
            /** At */
            at: string | null;
            /** Earliest At */
            earliest_at: string | null;
            /**
             * Latest At
             * @description Null for beyond five years.
             */
            latest_at: string | null;
        };
        /** Crossings */
        Crossings: {
            watch: components["schemas"]["Crossing"];
            act: components["schemas"]["Crossing"];
        };
        /**
         * Curve
         * @description Means of strokes and sides at each load (k,), in Nm: the residuals' shape and loop.
         */
        Curve: {
            /** Load Nm */
            load_nm: number[];
            /** Residual Nm */
            residual_nm: number[];
            /** Loop Nm */
            loop_nm: (number | null)[];
            /** Captures */
            captures: number[];
        };
        /**
         * Cut
         * @description A stretch in which limits held the motor back, seconds since the ride's start.
         */
        Cut: {
            /** From S */
            from_s: number;
            /** To S */
            to_s: number;
            /**
             * At S
             * @description Near its middle, where a limit is at work.
             */
            at_s: number;
            /** Limits */
            limits: string[];
        };
        /**
         * CutOff
         * @description What a kept circumference does to a limit. true_kmh: what is ridden when the bike says
         *     `limit_kmh`. lawful: with all of the uncertainty it stays at or below `limit_kmh` plus what the
         *     law's test allows.
         */
        CutOff: {
            /** Limit Kmh */
            limit_kmh: number;
            /** True Kmh */
            true_kmh: number;
            /** Expanded Kmh */
            expanded_kmh: number;
            /** Lawful */
            lawful: boolean;
        };
        /** Cuts */
        Cuts: {
            /** Items */
            items: components["schemas"]["Cut"][];
        };
        /**
         * Dashboard
         * @description What the rider sees. Rider power and motor power are two things; missing is null.
         */
        Dashboard: {
            /**
             * T Us
             * @description Unit time of the last row.
             */
            t_us: number | null;
            /** Speed Kmh */
            speed_kmh: number | null;
            /**
             * Acceleration Ms2
             * @description Over the last second.
             */
            acceleration_ms2: number | null;
            /**
             * Rider Power W
             * @description The rider's own, over the last second.
             */
            rider_power_w: number | null;
            /**
             * Motor Power W
             * @description Mechanical, at the motor's shaft; null from a unit that reports only what it demands of its
             *     motor.
             */
            motor_power_w: number | null;
            /** Battery Soc Pct */
            battery_soc_pct: number | null;
            /** Battery Voltage V */
            battery_voltage_v: number | null;
            /**
             * Distance Km
             * @description Since the unit's start or the last charge.
             */
            distance_km: number;
            /**
             * Missing S
             * @description Time since then whose rows never came.
             */
            missing_s: number;
            /**
             * Range Km
             * @description At the consumption since then; null until half a kilometre and half a percent.
             */
            range_km: number | null;
        };
        /**
         * Deviation
         * @description The largest difference between the file and the unit over a grid, and where it is.
         */
        Deviation: {
            /** Gain */
            gain: number;
            /** Speed Kmh */
            speed_kmh: number;
            /** Torque Rate */
            torque_rate: number;
            /** Gain Of File */
            gain_of_file: number;
            /** Gain Of Unit */
            gain_of_unit: number;
            /**
             * Samples
             * @description Of the output, ends included, with which the file was evaluated, as MATLAB does; the unit's
             *     centroid is exact. Null for a Sugeno system, which has none.
             */
            samples: number | null;
            /**
             * Points
             * @description So many were compared.
             */
            points: number;
        };
        /**
         * Device
         * @description A connection and the unit at its other end.
         *
         *     `reason` says in a sentence why the state is what it is.
         */
        Device: {
            /**
             * Id
             * @description Of the connection: made of its url, the same after every start. Where a path takes it, it
             *     takes the unit's serial number and `unit_key` too.
             */
            id: string;
            /** Url */
            url: string;
            /**
             * Kind
             * @enum {string}
             */
            kind: "simulated" | "serial" | "socket";
            /**
             * State
             * @enum {string}
             */
            state: "connecting" | "ready" | "read_only" | "lost" | "closed";
            /** Reason */
            reason: string;
            /**
             * Reason Code
             * @description A word for the reason, for programs and translations.
             */
            reason_code: string;
            identity: components["schemas"]["Identity"] | null;
            config: components["schemas"]["ConfigStamp"] | null;
            /**
             * Link
             * @description Counters of the link since it was added.
             */
            link: {
                [key: string]: number | null;
            };
            /** Faults Active */
            faults_active: string[];
            /**
             * Family
             * @description The make of the unit: what `?family=` of its url takes.
             */
            family: string;
            /**
             * Capabilities
             * @description What this unit can do. A route that needs another answers 409 `capability_missing` and names
             *     it.
             */
            capabilities: components["schemas"]["Capability"][];
            /**
             * Name
             * @description What its owner calls the unit, as it was added.
             */
            name: string | null;
            /**
             * Unit Key
             * @description Of the unit, whatever it is connected by: `family:serial`, else `family:name:NAME`, else
             *     `family:url:URL`. null until it said who it is. Its rides and its revisions have the same.
             */
            unit_key: string | null;
            /**
             * Bike Id
             * @description The bike the unit is on, made when it was first seen; null for a unit without a serial number
             *     and without a name.
             */
            bike_id: number | null;
            /**
             * Last Seen At
             * @description When the unit was last there over this connection, now if it is; null if none ever was. Kept
             *     over a restart, as are `identity` and `unit_key` of a unit that is away.
             */
            last_seen_at: string | null;
        };
        /**
         * DeviceFigure
         * @description A figure as the device that recorded stated it, by its own rules: none of `summary`.
         */
        DeviceFigure: {
            /**
             * Name
             * @description Of FIT's profile or of the file: `lev_battery_consumption`, `unknown_177`.
             */
            name: string;
            /** Value */
            value: number;
            /**
             * Unit
             * @description Empty for none, and where nothing tells it.
             * @default
             */
            unit: string;
        };
        /** DeviceHealth */
        DeviceHealth: {
            /** Id */
            id: string;
            /**
             * State
             * @enum {string}
             */
            state: "connecting" | "ready" | "read_only" | "lost" | "closed";
            recorder: components["schemas"]["RecorderHealth"];
        };
        /** DeviceList */
        DeviceList: {
            /** Items */
            items: components["schemas"]["Device"][];
            /** Next */
            next: string | null;
        };
        /** DeviceRequest */
        DeviceRequest: {
            /**
             * Url
             * @description `sim`, `sim:NAME?seed=1`, `/dev/ttyUSB0`, `COM3` or `socket://host:port`.
             */
            url: string;
            /**
             * Name
             * @description What you call the unit. A unit without a serial number is known by it, and nothing is written to it before it has one (409 `name_first`): give the same name each time. Adding the same url again with another name names it anew.
             */
            name?: string | null;
        };
        /**
         * DeviceSession
         * @description What the device stated of one whole session, which may reach beyond the ride.
         */
        DeviceSession: {
            /** From S */
            from_s: number;
            /** To S */
            to_s: number;
            /**
             * Figures
             * @default []
             */
            figures: components["schemas"]["DeviceFigure"][];
        };
        /**
         * DiagnosisCheck
         * @description One question; `impossible` where the ride lacks what it needs, named in `missing`: channels,
         *     values of the configuration, or a rest, fast rows, a straight way.
         */
        DiagnosisCheck: {
            /**
             * Name
             * @enum {string}
             */
            name: "zero_drift" | "saturation" | "drop_outs" | "brown_out" | "derating" | "implausible_speed" | "wheel";
            /**
             * State
             * @enum {string}
             */
            state: "clean" | "found" | "impossible";
            /**
             * Findings
             * @default []
             */
            findings: components["schemas"]["DiagnosisFinding"][];
            /**
             * Missing
             * @default []
             */
            missing: string[];
        };
        /**
         * DiagnosisFinding
         * @description Something that is not as it should be, with its evidence.
         */
        DiagnosisFinding: {
            /**
             * Kind
             * @description Which check found it, with what it found.
             * @enum {string}
             */
            kind: "zero_drift" | "saturation" | "rows_lost" | "sensor_silent" | "torque_late" | "brown_out" | "derating" | "speed_jump" | "speed_silent" | "wheel";
            /**
             * Severity
             * @enum {string}
             */
            severity: "note" | "warning" | "serious";
            /**
             * From S
             * @description Where to look first.
             */
            from_s: number;
            /**
             * To S
             * @description With `from_s`: where to look first.
             */
            to_s: number;
            /**
             * Numbers
             * @description By name with its unit, the threshold with it.
             */
            numbers: {
                [key: string]: number;
            };
            /**
             * Channel
             * @description What it is about, if it is one.
             */
            channel: string | null;
        };
        /**
         * Distribution
         * @description Time of a quantity, in means of a second.
         */
        Distribution: {
            /** Channel */
            channel: string;
            /**
             * Zones
             * @description Zones of `reference`; else plain bands.
             */
            zones: boolean;
            /** Reference */
            reference: number | null;
            /** Bands */
            bands: components["schemas"]["Band"][];
            /**
             * Mean
             * @description Of what is counted.
             */
            mean: number;
            /**
             * Most
             * @description The greatest mean of a second.
             */
            most: number;
            /** Valid S */
            valid_s: number;
            /**
             * Unknown S
             * @description Time without the quantity.
             */
            unknown_s: number;
        };
        /** DocumentParameter */
        DocumentParameter: {
            /** Value */
            value: number | string | (number | string)[] | (number | string)[][] | null;
            /** Unit */
            unit: string;
            /**
             * Comment
             * @default
             */
            comment: string;
        };
        /**
         * Doubt
         * @description A figure of the ride, and the other one, or the limit, that it does not agree with.
         */
        Doubt: {
            /**
             * Code
             * @enum {string}
             */
            code: "wheel_and_track" | "stated_distance" | "stated_time" | "stated_work" | "rows_left_out" | "values_left_out" | "speed" | "mean_speed" | "power" | "climb_rate" | "climb_share" | "motor_work";
            /** Figure */
            figure: number;
            /** Against */
            against: number;
            /** Unit */
            unit: string;
            /**
             * Channel
             * @description Whose values are left out.
             */
            channel: string | null;
            /**
             * Seconds
             * @description Over which the power is the mean.
             */
            seconds: number | null;
            /**
             * Accepted
             * @description By somebody who knows better: it keeps the ride from no record.
             * @default false
             */
            accepted: boolean;
        };
        /**
         * DriftTrend
         * @description Zero = a step for each calibration + temperature + age + scatter, by least squares.
         */
        DriftTrend: {
            /**
             * Rides
             * @description How many it is made of.
             */
            rides: number;
            per_month_nm: components["schemas"]["Share"];
            per_kelvin_nm: components["schemas"]["Share"] | null;
            /**
             * No Per Kelvin
             * @description Why temperature is not told apart: too few rides have one; all within 5 K.
             */
            no_per_kelvin: ("no_thermometer" | "same_weather") | null;
            /**
             * Typical Degc
             * @description Mean sensor temperature of these rides.
             */
            typical_degc: number | null;
            /**
             * Scatter Nm
             * @description Of rides, beyond what each knows of itself.
             */
            scatter_nm: number;
            today: components["schemas"]["BandPoint"];
            crossings: components["schemas"]["Crossings"];
            /**
             * Bands
             * @description To draw; one for each calibration.
             */
            bands: components["schemas"]["BandPoint"][][];
        };
        /**
         * EnergyShare
         * @description Rider, motor and battery side by side; null where it was not measured. Never added up.
         */
        EnergyShare: {
            /** Seconds */
            seconds: number;
            /** Distance Km */
            distance_km: number | null;
            /** Rider Wh */
            rider_wh: number | null;
            /** Motor Wh */
            motor_wh: number | null;
            /** Battery Wh */
            battery_wh: number | null;
            /**
             * Motor Per Rider
             * @description The motor's work over the rider's, of the moments in which both are known.
             */
            motor_per_rider: number | null;
        };
        /**
         * ErasedLog
         * @description A log that was freed.
         *
         *     erases: blocks of the unit's flash for logs erased in its life; None where the unit's answer was
         *     lost and the log is gone.
         */
        ErasedLog: {
            /** Log Id */
            log_id: number;
            /**
             * Erases
             * @description Blocks of the flash for logs erased in its life; null if its answer was lost.
             */
            erases: number | null;
        };
        /**
         * Estimate
         * @description recorded: as ridden. replayed: with the change, less what the twin errs by without it.
         *     difference: what the change makes. low, high: the band, in which nine of ten simulated rides
         *     lay.
         */
        Estimate: {
            /** Recorded */
            recorded: number;
            /** Replayed */
            replayed: number;
            /** Difference */
            difference: number;
            /** Low */
            low: number;
            /** High */
            high: number;
        };
        /**
         * Evaluation
         * @description The figures of an error test, in percent of full scale.
         */
        Evaluation: {
            /**
             * Linearity Pct
             * @description Against the load, as the thesis uses it.
             */
            linearity_pct: number;
            /** Hysteresis Pct */
            hysteresis_pct: number;
            repeatability_pct: components["schemas"]["TwoDefinitions"];
            total_pct: components["schemas"]["TwoDefinitions"];
            fit: components["schemas"]["LineFit"];
            linearity_against_line_pct: components["schemas"]["LinearityAgainstLines"];
            /**
             * Worst
             * @description Where each figure has its largest value.
             */
            worst: {
                [key: string]: number | string | null;
            };
        };
        /**
         * EvaluationRequest
         * @description Readings in Nm of `r` strokes over the `k` loads, rising and falling.
         */
        EvaluationRequest: {
            /** Full Scale Nm */
            full_scale_nm: number;
            /** Load Nm */
            load_nm: number[];
            /** Forward */
            forward: number[][];
            /** Reverse */
            reverse: number[][];
        };
        /**
         * Fault
         * @description A fault that is active or was. `frozen` is what the bike did when it came last.
         */
        Fault: {
            /** Name */
            name: string;
            /**
             * Description
             * @description What the rider reads.
             */
            description: string;
            /**
             * Active
             * @default true
             */
            active: boolean;
            /**
             * Count
             * @description How often since the unit's start; null if not known.
             */
            count: number | null;
            frozen: components["schemas"]["Snapshot"] | null;
            /**
             * Severity
             * @description A warning only; no assist while it lasts; no assist until cleared at standstill.
             * @default latched
             * @enum {string}
             */
            severity: "warning" | "assist_off" | "latched";
            /**
             * Mechanic Text
             * @description What a mechanic measures and mends.
             * @default
             */
            mechanic_text: string;
        };
        /** FaultList */
        FaultList: {
            /** Items */
            items: components["schemas"]["Fault"][];
            /** Next */
            next: string | null;
        };
        /**
         * FaultMoment
         * @description What the bike did from 2 s before a fault to 1 s after it, as it was recorded.
         */
        FaultMoment: {
            /** Fault */
            fault: string;
            /**
             * Unit T Us
             * @description When it came last, on the unit's clock.
             */
            unit_t_us: number | null;
            /**
             * Occurred At
             * @description The same as wall time, where samples tell it.
             */
            occurred_at: string | null;
            /**
             * Source
             * @description What had the samples.
             */
            source: ("ride" | "stream") | null;
            /**
             * Missing
             * @description Why there is no sample: it is unknown when the fault came, or nothing was recorded then; null
             *     where there are some.
             */
            missing: ("no_frame" | "not_recorded") | null;
            /** Ride Id */
            ride_id: number | null;
            /**
             * Ride T S
             * @description The fault's place in the ride.
             */
            ride_t_s: number | null;
            /** Motor Torque Meaning */
            motor_torque_meaning: ("demanded" | "delivered") | null;
            /**
             * Complete
             * @description False while samples after the fault are still to come.
             * @default true
             */
            complete: boolean;
            /**
             * At S
             * @description Of each sample; the fault came at 0.
             * @default []
             */
            at_s: number[];
            /**
             * Rider Torque Nm
             * @description At the crank; null: no reading.
             * @default []
             */
            rider_torque_nm: (number | null)[];
            /**
             * Motor Torque Nm
             * @description At the crank; null: no reading, or no gear ratio is known.
             * @default []
             */
            motor_torque_nm: (number | null)[];
        };
        /**
         * Feel
         * @description Measured on the simulated bike, 100 kg on the level; null where it never came to that.
         */
        Feel: {
            /**
             * Start S
             * @description From rest to 15 km/h under legs.
             */
            start_s: number | null;
            /**
             * Rise Nm Per S
             * @description Steepest rise of the motor's torque on the way.
             */
            rise_nm_per_s: number;
            /**
             * Ripple Pct
             * @description Rms of the motor's torque about its mean over half a turn of the crank, as a share of it,
             *     under even legs.
             */
            ripple_pct: number | null;
            /**
             * Lag Ms
             * @description To 63 % of what a sudden push changes.
             */
            lag_ms: number | null;
            /**
             * Toggles Hz
             * @description On and off a second under legs that hold 25 km/h.
             */
            toggles_hz: number;
            /**
             * Market
             * @description That the simulated unit was made for.
             */
            market: string;
            /**
             * Seconds
             * @description What measuring took.
             */
            seconds: number;
        };
        /**
         * Figure
         * @description A Plotly figure, for `Plotly.newPlot`.
         */
        Figure: {
            /** Data */
            data: {
                [key: string]: unknown;
            }[];
            /** Layout */
            layout: {
                [key: string]: unknown;
            };
        };
        /**
         * FigureValue
         * @description A figure of one side.
         */
        FigureValue: {
            /** Value */
            value: number | null;
            /**
             * Missing
             * @description Why there is no value; null with one.
             */
            missing: ("no_speed" | "no_way" | "no_motion" | "no_rider_power" | "no_motor_power" | "no_battery_power" | "only_asked" | "no_height" | "no_rider_work") | null;
            /**
             * Unknown S
             * @description Time that an energy leaves out because its samples are missing.
             */
            unknown_s: number | null;
        };
        /**
         * Filled
         * @description A stretch the recording lacked, filled from the unit's own log at the log's rate.
         *
         *     Of the `rows_lost` rows in it `rows_filled` have samples now; nothing was interpolated.
         */
        Filled: {
            /** From S */
            from_s: number;
            /** To S */
            to_s: number;
            /**
             * Rows Lost
             * @description Rows of the ride that lie in it.
             */
            rows_lost: number;
            /**
             * Rows Filled
             * @description So many of them have samples now.
             */
            rows_filled: number;
            /**
             * Period Us
             * @description Spacing of the source's rows.
             */
            period_us: number;
            /**
             * Source
             * @default unit_log
             * @constant
             */
            source: "unit_log";
        };
        /**
         * Finding
         * @description code: for programs. message: for people. where: the cell, point or field; None for all.
         *
         *     values: the figures of the message, by name, for translations.
         */
        Finding: {
            /**
             * Code
             * @description For programs.
             */
            code: string;
            /**
             * Message
             * @description For people.
             */
            message: string;
            /**
             * Where
             * @description The cell, point or field; null for all.
             */
            where: string | null;
            /**
             * Values
             * @description What the message tells, by name, for a text in another language.
             */
            values: {
                [key: string]: number | string;
            };
        };
        /**
         * FiredRule
         * @description Its cell, `[row][column]` of the table's rules, and how much it had to say.
         */
        FiredRule: {
            /** Row */
            row: number;
            /** Column */
            column: number;
            /**
             * Label
             * @enum {string}
             */
            label: "NB" | "NS" | "ZO" | "PS" | "PB";
            /**
             * Weight
             * @description Above 0, to 1: the lesser of the two memberships under `mamdani_centroid`, their product
             *     under `weighted_average`.
             */
            weight: number;
        };
        /**
         * FirstPerson
         * @description The first administrator.
         */
        FirstPerson: {
            /** Name */
            name: string;
            /**
             * Password
             * Format: password
             * @description At least 8 characters, none of the commonest; no other rule.
             */
            password: string;
            /**
             * Token
             * Format: password
             * @description Of the link the server printed.
             */
            token: string;
        };
        /**
         * FisText
         * @description A `.fis` file as text.
         */
        FisText: {
            /** Text */
            text: string;
            /**
             * Name
             * @description The file's own word if empty.
             * @default
             */
            name: string;
        };
        /**
         * Fit
         * @description covariance: of the coefficients in `names`, from the scatter alone. repeatability_nm:
         *     standard deviation of one capture beyond its own noise. temperature: `both`, `offset` or
         *     `none`, with `temperature_span_k` that the captures cover; None without temperatures.
         */
        Fit: {
            coefficients: components["schemas"]["Coefficients"];
            /** Names */
            names: string[];
            /** Covariance */
            covariance: number[][];
            /** Common */
            common: components["schemas"]["Common"][];
            /** Repeatability Nm */
            repeatability_nm: number;
            /** Degrees Of Freedom */
            degrees_of_freedom: number;
            /** Temperature */
            temperature: string;
            /** Temperature Span K */
            temperature_span_k: number | null;
            /** Residuals */
            residuals: components["schemas"]["Residual"][];
        };
        /**
         * Free
         * @description Without the maker's token a value may be set from here to there.
         */
        Free: {
            /** Min */
            min: number;
            /** Max */
            max: number;
            /**
             * Around
             * @description The parameter that holds what the factory measured.
             */
            around: string;
        };
        /**
         * FuzzyTable
         * @description Five by five rules: `rules[speed][torque rate]`.
         */
        FuzzyTable: {
            /** Name */
            name: string;
            /**
             * Inference
             * @enum {string}
             */
            inference: "mamdani_centroid" | "weighted_average";
            /** Speed Points Kmh */
            speed_points_kmh: number[];
            /** Torque Rate Points */
            torque_rate_points: number[];
            /** Gain Points */
            gain_points: number[];
            /** Rules */
            rules: ("NB" | "NS" | "ZO" | "PS" | "PB")[][];
        };
        /**
         * GainMap
         * @description Time over speed and gain: seconds[speed][gain], cells of these steps from zero on.
         */
        GainMap: {
            /** Speed Step Kmh */
            speed_step_kmh: number;
            /** Gain Step */
            gain_step: number;
            /** Seconds */
            seconds: number[][];
        };
        /**
         * Gap
         * @description A stretch without samples; `rows_lost` where it is known.
         */
        Gap: {
            /** From S */
            from_s: number;
            /** To S */
            to_s: number;
            /** Rows Lost */
            rows_lost: number | null;
        };
        /**
         * GradientEnergy
         * @description Of the rows whose gradient lies from `from_pct` up to `to_pct`; null for no end.
         */
        GradientEnergy: {
            /** Seconds */
            seconds: number;
            /** Distance Km */
            distance_km: number | null;
            /** Rider Wh */
            rider_wh: number | null;
            /** Motor Wh */
            motor_wh: number | null;
            /** Battery Wh */
            battery_wh: number | null;
            /**
             * Motor Per Rider
             * @description The motor's work over the rider's, of the moments in which both are known.
             */
            motor_per_rider: number | null;
            /** From Pct */
            from_pct: number | null;
            /** To Pct */
            to_pct: number | null;
        };
        /**
         * Gravity
         * @description What a kilogram weighs here.
         *
         *     standard_ms2: standard uncertainty. source: `given`, or `place` with latitude and height.
         */
        Gravity: {
            /** Gravity Ms2 */
            gravity_ms2: number;
            /** Standard Ms2 */
            standard_ms2: number;
            /**
             * Source
             * @enum {string}
             */
            source: "given" | "place";
            /** Latitude Deg */
            latitude_deg?: number | null;
            /** Height M */
            height_m?: number | null;
        };
        /**
         * GravityAt
         * @description Of a place, by the normal gravity of WGS 84 with its free-air correction.
         */
        GravityAt: {
            /** Latitude Deg */
            latitude_deg: number;
            /** Height M */
            height_m: number;
            /**
             * Height Standard M
             * @default 50
             */
            height_standard_m: number;
        };
        /** GravityInput */
        GravityInput: {
            /** Gravity Ms2 */
            gravity_ms2: number;
            /**
             * Standard Ms2
             * @description Its standard uncertainty.
             */
            standard_ms2: number;
        };
        /** Health */
        Health: {
            /**
             * Status
             * @description `degraded` while something that is to be kept cannot be written.
             * @enum {string}
             */
            status: "ok" | "degraded";
            /** Version */
            version: string;
            /**
             * Reasons
             * @description Why. With status ok too: `rows_lost` and `rows_missing_*` until the unit's next ride, the
             *     latter with where most of them were lost; `rides_damaged` until the files are restored or the
             *     rides deleted.
             */
            reasons: components["schemas"]["HealthReason"][];
            /** Devices */
            devices: components["schemas"]["DeviceHealth"][];
        };
        /** HealthReason */
        HealthReason: {
            /**
             * Code
             * @enum {string}
             */
            code: "disk_full" | "store_read_only" | "io_error" | "queue_full" | "database_unreachable" | "database_damaged" | "objects_unreachable" | "objects_refused" | "rows_lost" | "rows_missing_machine" | "rows_missing_line" | "rows_missing_unit" | "rides_damaged";
            /** Message */
            message: string;
            /**
             * Part
             * @description What it is about: a part of the store, or the id of a unit.
             */
            part: string;
        };
        /**
         * HistoryAdded
         * @description What a bike's history brought.
         */
        HistoryAdded: {
            /** Added */
            added: number;
            /**
             * Known
             * @description Visits that were here already; they stay as they are.
             */
            known: number;
        };
        /**
         * Identity
         * @description Who a unit says it is, in words and hexadecimal; null for what it does not say, never "".
         */
        Identity: {
            /**
             * Serial Number
             * @description Lasts as long as the unit.
             */
            serial_number: string | null;
            /** Model */
            model: string;
            /** Firmware Version */
            firmware_version: string | null;
            /** Hardware Revision */
            hardware_revision: number | null;
            /** Protocol Version */
            protocol_version: string | null;
            /** Schema Hash */
            schema_hash: string | null;
            /**
             * Simulated
             * @default false
             */
            simulated: boolean;
            /**
             * Boot Id
             * @description Another one at every start of the unit.
             */
            boot_id: number | null;
            /**
             * Reset Cause
             * @description Why the unit started: `power_on`, `brown_out`, `watchdog`, `fault_handler`, `deadline` or
             *     `software`; null where its firmware cannot tell.
             */
            reset_cause: string | null;
        };
        /**
         * Instrument
         * @description The device that recorded, or one that it heard; null for what the file does not tell.
         */
        Instrument: {
            /**
             * Kind
             * @description `recorder`, or what it measures: `bike_power`.
             */
            kind: string | null;
            /** Maker */
            maker: string | null;
            /** Product */
            product: string | null;
            /** Serial Number */
            serial_number: string | null;
            /** Software Version */
            software_version: string | null;
            /**
             * Battery V
             * @description Of its own battery.
             */
            battery_v: number | null;
            /**
             * Battery Status
             * @description The last that was reported.
             */
            battery_status: string | null;
        };
        /**
         * Intake
         * @description What became of every row and field of the file: kept, or counted here with the reason.
         *
         *     rows_read = rows_kept + rows_joined + the sum of rows_dropped.
         */
        Intake: {
            /**
             * Rows Read
             * @default 0
             */
            rows_read: number;
            /**
             * Rows Kept
             * @default 0
             */
            rows_kept: number;
            /**
             * Rows Joined
             * @description Of one time, each with a part of the values.
             * @default 0
             */
            rows_joined: number;
            /**
             * Rows Spread
             * @description Of one time with values of their own; they stand evenly within it.
             * @default 0
             */
            rows_spread: number;
            /**
             * Rows Moved
             * @description How often the clock went back.
             * @default 0
             */
            rows_moved: number;
            /**
             * Rows Dropped
             * @description By reason: no_time, clock_not_set, clock_jumped, no_value.
             */
            rows_dropped: {
                [key: string]: number;
            };
            /**
             * Values Dropped
             * @description By channel: what no bike can do, single samples far from both neighbours, positions that
             *     nobody could have reached.
             */
            values_dropped: {
                [key: string]: number;
            };
            /**
             * Restarts
             * @description By channel, or `time`: how often a count began anew; it goes on where it was.
             */
            restarts: {
                [key: string]: number;
            };
            /**
             * Turned
             * @description Channels whose sign was turned: a controller mounted the other way round.
             * @default []
             */
            turned: string[];
            /**
             * Fields Unread
             * @description By name, in how many rows: text, bytes and lists of numbers.
             */
            fields_unread: {
                [key: string]: number;
            };
            /**
             * Taken As
             * @description What the file does not say, and what it was taken as: `time_zone`, `rows_per_second`,
             *     `date_order`, a column's unit, its channel or `left out`. `start`: where its date is from.
             *     `clock`: the zone that its two clocks, one of UTC, are apart.
             */
            taken_as: {
                [key: string]: string;
            };
        };
        /**
         * Job
         * @description All of a calibration, so that a page has nothing to work out.
         */
        Job: {
            /** Id */
            id: number;
            /**
             * State
             * @enum {string}
             */
            state: "setup" | "capturing" | "fitted" | "written" | "verified" | "closed";
            /** Unit Key */
            unit_key: string;
            /** Bike Id */
            bike_id: number | null;
            /** Model */
            model: string | null;
            /**
             * Opened At
             * Format: date-time
             */
            opened_at: string;
            /** Closed At */
            closed_at: string | null;
            /** Author */
            author: string;
            /** Author Proof */
            author_proof: ("stated" | "signed_in") | null;
            /**
             * File Sha256
             * @description Of the file of a closed one.
             */
            file_sha256: string | null;
            result: components["schemas"]["Result"];
            /**
             * Device Id
             * @description The connection its unit is on now.
             */
            device_id: string | null;
            /** Serial Number */
            serial_number: string | null;
            /** Firmware Version */
            firmware_version: string | null;
            /** Market */
            market: string | null;
            /**
             * May
             * @description What can be done now.
             */
            may: ("setup" | "capture" | "fit" | "write" | "verify" | "restore" | "close")[];
            /**
             * Found
             * @description The unit's record when the job was opened.
             */
            found: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
            setup: components["schemas"]["Setup"] | null;
            /** @description The newest of another job here. */
            suggested_setup: components["schemas"]["Setup"] | null;
            /** Steps */
            steps: components["schemas"]["Step"][];
            /**
             * Next Step
             * @description Index into `steps`; null: all are done.
             */
            next_step: number | null;
            /**
             * Checks
             * @description Of this moment; empty without a connection.
             */
            checks: components["schemas"]["Check"][];
            /** Captures */
            captures: components["schemas"]["CaptureSummary"][];
            /** @description All that follows from setup and captures. */
            worked: components["schemas"]["Worked"] | null;
            /**
             * Fitted At
             * @description Since when nothing of these changed after the fit.
             */
            fitted_at: string | null;
            /**
             * Certificate Sha256
             * @description What the unit's record is written with.
             */
            certificate_sha256: string | null;
            /** Record */
            record: components["schemas"]["RecordLine"][];
            /** Changes */
            changes: components["schemas"]["RecordChange"][];
            /**
             * Expanded
             * @description Uncertainty (k = 2) of each coefficient that was fitted, by its name.
             */
            expanded: {
                [key: string]: number;
            };
            /**
             * Unsure
             * @description Begun, with unknown outcome in the unit; repeating it finds out.
             */
            unsure: ("write" | "restore") | null;
            /** Clock Set */
            clock_set: components["schemas"]["ClockSet"][];
            /** Earlier Of Bike */
            earlier_of_bike: components["schemas"]["JobSummary"][];
            /** Earlier Of Model */
            earlier_of_model: components["schemas"]["JobSummary"][];
            /** @description Since the last one of this unit. */
            change: components["schemas"]["Change"] | null;
            /** @description Against the newest of each other unit of the model. */
            among_model: components["schemas"]["AmongModel"] | null;
        };
        /** JobList */
        JobList: {
            /** Items */
            items: components["schemas"]["JobSummary"][];
        };
        /** JobRequest */
        JobRequest: {
            /** Device Id */
            device_id: string;
        };
        /**
         * JobSummary
         * @description One line of a list.
         */
        JobSummary: {
            /** Id */
            id: number;
            /**
             * State
             * @enum {string}
             */
            state: "setup" | "capturing" | "fitted" | "written" | "verified" | "closed";
            /** Unit Key */
            unit_key: string;
            /** Bike Id */
            bike_id: number | null;
            /** Model */
            model: string | null;
            /**
             * Opened At
             * Format: date-time
             */
            opened_at: string;
            /** Closed At */
            closed_at: string | null;
            /** Author */
            author: string;
            /** Author Proof */
            author_proof: ("stated" | "signed_in") | null;
            /**
             * File Sha256
             * @description Of the file of a closed one.
             */
            file_sha256: string | null;
            result: components["schemas"]["Result"];
        };
        /** Joined */
        Joined: {
            person: components["schemas"]["Person"];
            /** Bike Id */
            bike_id: number;
        };
        /**
         * Judgement
         * @description verdict: by the heaviest cause. limits: those that were used.
         */
        Judgement: {
            /**
             * Verdict
             * @enum {string}
             */
            verdict: "pass" | "conditional" | "fail";
            /** Causes */
            causes: components["schemas"]["Cause"][];
            limits: components["schemas"]["Limits"];
        };
        /**
         * Lap
         * @description A part of the ride that was marked off, in seconds after its start; null for untold.
         */
        Lap: {
            /** From S */
            from_s: number;
            /** To S */
            to_s: number;
            /**
             * Trigger
             * @description manual, time, distance, position, session_end, other; null for untold.
             */
            trigger: string | null;
            /**
             * Timer S
             * @description Time the device's timer ran.
             */
            timer_s: number | null;
            /**
             * Distance M
             * @description As the device counted it; null where it did not.
             */
            distance_m: number | null;
            /**
             * Calories Kcal
             * @description As the device counted them; null where it did not.
             */
            calories_kcal: number | null;
        };
        /**
         * LapFigures
         * @description A lap of the device that recorded the ride.
         */
        LapFigures: {
            /** From S */
            from_s: number;
            /** To S */
            to_s: number;
            /**
             * Seconds
             * @description Of the rows in the lap.
             */
            seconds: number;
            /** Distance Km */
            distance_km: number | null;
            /** Rider Power W Mean */
            rider_power_w_mean: number | null;
            /** Motor Power W Mean */
            motor_power_w_mean: number | null;
            /** Heart Rate Bpm Mean */
            heart_rate_bpm_mean: number | null;
        };
        /**
         * LargestDifference
         * @description Where two surfaces are furthest apart.
         */
        LargestDifference: {
            /**
             * Gain
             * @description Right less left.
             */
            gain: number;
            /** Speed Kmh */
            speed_kmh: number;
            /** Torque Rate */
            torque_rate: number;
            /** Left */
            left: number;
            /** Right */
            right: number;
        };
        /**
         * LastKnown
         * @description What a unit was last known to be set to. Nothing can be written on it: it has no ETag.
         */
        LastKnown: {
            /** Unit Key */
            unit_key: string;
            /**
             * Seen At
             * @description When the unit was last there.
             */
            seen_at: string | null;
            /**
             * Recorded At
             * Format: date-time
             * @description When this configuration was read from it.
             */
            recorded_at: string;
            /** Generation */
            generation: number | null;
            /** Crc32 */
            crc32: number | null;
            /** Parameters */
            parameters: components["schemas"]["Parameter"][];
        };
        /**
         * Ledger
         * @description Who carried the motor's energy, delivered at its shaft. Missing is null.
         *
         *     The modes' energies add up to `motor_wh`, and so do those of the rules and `without_rule_wh`:
         *     what fixed modes, walk assist and a motor that runs out gave.
         */
        Ledger: {
            /** Ride Id */
            ride_id: number;
            /**
             * Config Source
             * @enum {string}
             */
            config_source: "ride" | "defaults";
            /**
             * Motor Wh
             * @description Null for a ride that tells only what was asked of its motor.
             */
            motor_wh: number | null;
            /**
             * Motor Excluded S
             * @description Time in which the motor's power is not known.
             */
            motor_excluded_s: number;
            /** Modes */
            modes: components["schemas"]["ModeShare"][];
            /**
             * Rules
             * @description The most first; null where the ride's configuration or its motor's energy is not known.
             */
            rules: components["schemas"]["RuleShare"][] | null;
            /** Without Rule Wh */
            without_rule_wh: number | null;
        };
        /**
         * LibraryDocument
         * @description A document that is to be kept: what `GET /library/{id}` and `spindle device backup` give.
         *
         *     What it says of a unit, `identity`, `unit_key`, `generation` and `crc32`, is not kept.
         */
        LibraryDocument: {
            /**
             * Format
             * @enum {string}
             */
            format: "spindle-table" | "spindle-configuration";
            /**
             * Version
             * @description 1; what a newer Spindle wrote is refused.
             */
            version: number;
            /** Name */
            name: string;
            /** Comment */
            comment: string;
            /** Family */
            family: string;
            /** Parameters */
            parameters: {
                [key: string]: components["schemas"]["DocumentParameter"];
            };
            /** Identity */
            identity?: {
                [key: string]: unknown;
            } | null;
            /** Unit Key */
            unit_key?: string | null;
            /** Generation */
            generation?: number | null;
            /** Crc32 */
            crc32?: number | null;
        };
        /**
         * LibraryEntry
         * @description A file as `spindle device restore` takes it; a table holds the parameters of one table.
         */
        LibraryEntry: {
            /**
             * Format
             * @enum {string}
             */
            format: "spindle-table" | "spindle-configuration";
            /**
             * Version
             * @constant
             */
            version: 1;
            /** Name */
            name: string;
            /** Comment */
            comment: string;
            /** Family */
            family: string;
            /** Parameters */
            parameters: {
                [key: string]: components["schemas"]["LibraryParameter"];
            };
        };
        /** LibraryList */
        LibraryList: {
            /** Items */
            items: components["schemas"]["LibraryRow"][];
            /** Next */
            next: string | null;
        };
        /** LibraryParameter */
        LibraryParameter: {
            /** Value */
            value: number | string | (number | string)[] | (number | string)[][] | null;
            /**
             * Unit
             * @description Empty for a number without one, and for a text or a choice.
             */
            unit: string;
            /**
             * Comment
             * @default
             */
            comment: string;
        };
        /**
         * LibraryRow
         * @description One entry without its values.
         */
        LibraryRow: {
            /**
             * Id
             * @description What the entry is requested by.
             */
            id: string;
            /** Name */
            name: string;
            /**
             * Kind
             * @enum {string}
             */
            kind: "table" | "configuration";
            /**
             * Comment
             * @description What it is good for.
             */
            comment: string;
            /**
             * Family
             * @description Of the units it is for.
             */
            family: string;
            /**
             * Source
             * @description `preset`: it comes with Spindle, read only. `own`: a user keeps it here.
             * @enum {string}
             */
            source: "preset" | "own";
            /**
             * Etag
             * @description Of what it is; `If-Match` of a change.
             */
            etag: string;
            /**
             * Deleted
             * @default false
             */
            deleted: boolean;
            /**
             * Version
             * @description Counts the states of an own item from 1.
             */
            version: number | null;
            /** Created At */
            created_at: string | null;
            /** Changed At */
            changed_at: string | null;
            /**
             * Author
             * @description Who gave it this state.
             */
            author: string | null;
            /**
             * Author Proof
             * @description How the author is known: `stated` is by their own word, `signed_in` by an account or a
             *     key.
             */
            author_proof: ("stated" | "signed_in") | null;
        };
        /**
         * LimitProof
         * @description Float32 rounding is within every bound. `holds`: every claim keeps the market's law, and
         *     the unit runs the firmware that was proven.
         */
        LimitProof: {
            /**
             * Sha256
             * @description Of all that follows but `holds`, `unproven`, `created_at`.
             */
            sha256: string;
            /**
             * Config Sha256
             * @description Of all that the law reads of the configuration.
             */
            config_sha256: string;
            /** Table Sha256 */
            table_sha256: string;
            /** Market */
            market: string;
            /** Market Sha256 */
            market_sha256: string;
            /**
             * Firmware Version
             * @description Whose C was proven.
             */
            firmware_version: string;
            /** Method */
            method: number;
            /** Holds */
            holds: boolean;
            /**
             * Unproven
             * @description Why nothing is said of this unit; null if something is.
             */
            unproven: "other_firmware" | null;
            /** Claims */
            claims: components["schemas"]["Claim"][];
            /** Cells */
            cells: components["schemas"]["Cell"][];
            /**
             * Not Covered
             * @description What no proof about the law can hold.
             */
            not_covered: string[];
            /**
             * Created At
             * @description When it was first made here.
             */
            created_at: string | null;
        };
        /**
         * LimitProofRequest
         * @description Of a unit's configuration, one of its revisions, an entry of the library, or the law's
         *     defaults; tables, modes, limits and parameters take the place of theirs.
         */
        LimitProofRequest: {
            /** Device Id */
            device_id?: string | null;
            /**
             * Revision
             * @description Of the unit.
             */
            revision?: number | null;
            /**
             * Library
             * @description An entry's id.
             */
            library?: string | null;
            fuzzy_table?: components["schemas"]["FuzzyTable"] | null;
            /** @description Shares speed and torque-rate points with the first. */
            second_table?: components["schemas"]["FuzzyTable"] | null;
            assist_modes?: components["schemas"]["AssistModes"] | null;
            limits?: components["schemas"]["UnitLimits"] | null;
            /** Parameters */
            parameters?: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
        };
        /**
         * Limits
         * @description Percent of full scale, unless the name says otherwise.
         *
         *     source: who says so. expanded_pct: of the whole budget, k = 2. reference_pct: of what arm,
         *     masses, gravity and level leave open, k = 2. gain_change_pct: of the unit's gain, found against
         *     kept. left_right_pct, bending_pct: of the load. made_gain_pct: of the gain that the unit was
         *     made with; None in certificates from before there was this limit.
         */
        Limits: {
            /**
             * Source
             * @default example limits
             */
            source: string;
            /** Market */
            market?: string | null;
            /** Model */
            model?: string | null;
            /**
             * Linearity Pct
             * @default 0.7
             */
            linearity_pct: number;
            /**
             * Hysteresis Pct
             * @default 0.3
             */
            hysteresis_pct: number;
            /**
             * Repeatability Pct
             * @default 0.6
             */
            repeatability_pct: number;
            /**
             * Zero Return Pct
             * @default 0.3
             */
            zero_return_pct: number;
            /**
             * Total Pct
             * @default 1
             */
            total_pct: number;
            /**
             * Expanded Pct
             * @default 1
             */
            expanded_pct: number;
            /**
             * Reference Pct
             * @default 0.5
             */
            reference_pct: number;
            /**
             * Left Right Pct
             * @default 1
             */
            left_right_pct: number;
            /**
             * Bending Pct
             * @default 1
             */
            bending_pct: number;
            /**
             * Gain Change Pct
             * @default 1
             */
            gain_change_pct: number;
            /** Made Gain Pct */
            made_gain_pct?: number | null;
        };
        /**
         * LineFit
         * @description Least-squares line through the mean readings: reading = slope x load + offset.
         */
        LineFit: {
            /** Slope */
            slope: number;
            /** Offset Nm */
            offset_nm: number;
        };
        /**
         * LinearityAgainstLines
         * @description Linearity against a line instead of the load; the rest is gain error (thesis_checks I-6).
         */
        LinearityAgainstLines: {
            /** Least Squares */
            least_squares: number;
            /** Through Zero */
            through_zero: number;
            /** End Point */
            end_point: number;
        };
        /**
         * LintReport
         * @description errors: cannot be written. warnings: need a reason. notes: good to know.
         */
        LintReport: {
            /**
             * Errors
             * @description Cannot be written.
             */
            errors: components["schemas"]["Finding"][];
            /**
             * Warnings
             * @description Need a reason.
             */
            warnings: components["schemas"]["Finding"][];
            /**
             * Notes
             * @description Good to know.
             */
            notes: components["schemas"]["Finding"][];
        };
        /** LintRequest */
        LintRequest: {
            fuzzy_table: components["schemas"]["FuzzyTable"];
            assist_modes?: components["schemas"]["AssistModes"] | null;
            limits?: components["schemas"]["UnitLimits"] | null;
            /**
             * Table
             * @description Which of the unit's tables this is: modes that use the other are not judged.
             * @default first
             * @enum {string}
             */
            table: "first" | "second";
            /**
             * Taper Speeds Kmh
             * @description `fixed_taper_start_kmh` and `fixed_taper_end_kmh`; without them fixed modes that taper between them are not judged.
             */
            taper_speeds_kmh?: [
                number,
                number
            ] | null;
            /**
             * Gear Ratio
             * @description The unit's own, motor turns per crank turn; else the registry's default.
             */
            gear_ratio?: number | null;
        };
        /**
         * LoadShare
         * @description A share of the load of a level crank, and its standard uncertainty.
         */
        LoadShare: {
            /** Share */
            share: number;
            /** Standard */
            standard: number;
        };
        /**
         * LogDownload
         * @description From `waiting` to `done` or `failed`; only then the unit may free the log.
         */
        LogDownload: {
            /**
             * State
             * @enum {string}
             */
            state: "waiting" | "fetching" | "checking" | "keeping" | "done" | "failed";
            /** Received */
            received: number;
            /** Length */
            length: number;
            /** Bytes Per S */
            bytes_per_s: number | null;
            /** Detail */
            detail: string | null;
            /** Upload Id */
            upload_id: string | null;
            /**
             * Ride Id
             * @description The ride it became or was already.
             */
            ride_id: number | null;
            /**
             * Duplicate Of
             * @description The ride that was here before; null if new.
             */
            duplicate_of: number | null;
            /**
             * Confirmed
             * @description Whether the unit knows that the log is safe.
             */
            confirmed: boolean;
        };
        /**
         * Mass
         * @description One weight of the set: of a class of OIML R 111, or weighed to within `limit_kg`.
         */
        Mass: {
            /** Name */
            name: string;
            /** Mass Kg */
            mass_kg: number;
            /** Mass Class */
            mass_class?: ("E2" | "F1" | "F2" | "M1" | "M2" | "M3") | null;
            /** Limit Kg */
            limit_kg?: number | null;
        };
        /**
         * MassRequest
         * @description One weight: of a class of OIML R 111, or weighed to within `limit_kg`.
         */
        MassRequest: {
            /** Name */
            name: string;
            /** Mass Kg */
            mass_kg: number;
            /** Mass Class */
            mass_class?: ("E2" | "F1" | "F2" | "M1" | "M2" | "M3") | null;
            /** Limit Kg */
            limit_kg?: number | null;
        };
        /**
         * ModeCurve
         * @description Of one mode, at the crank, after every limit.
         */
        ModeCurve: {
            /**
             * Torque Nm
             * @description At each speed.
             */
            torque_nm: number[];
            /**
             * Torque Nm Most
             * @description For a push of `hard_push_nm`, over the speeds.
             */
            torque_nm_most: number;
            /**
             * Power W Most
             * @description That torque at `cadence_rpm`.
             */
            power_w_most: number;
        };
        /**
         * ModeCurves
         * @description With a battery at its nominal voltage, a cool motor, and the cranks at `cadence_rpm`.
         */
        ModeCurves: {
            /** Cadence Rpm */
            cadence_rpm: number;
            /** Hard Push Nm */
            hard_push_nm: number;
            /**
             * Modes
             * @description By slot.
             */
            modes: components["schemas"]["ModeCurve"][];
            /** Engine */
            engine: string;
        };
        /**
         * ModeCurvesRequest
         * @description A configuration as it is edited; what is left out has the law's defaults.
         */
        ModeCurvesRequest: {
            /** Parameters */
            parameters: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
            /**
             * Rider Torque Nm
             * @default 30
             */
            rider_torque_nm: number;
            /**
             * Speeds Kmh
             * @description Increasing; each is held for two seconds.
             */
            speeds_kmh: number[];
        };
        /** ModeEnergy */
        ModeEnergy: {
            /** Seconds */
            seconds: number;
            /** Distance Km */
            distance_km: number | null;
            /** Rider Wh */
            rider_wh: number | null;
            /** Motor Wh */
            motor_wh: number | null;
            /** Battery Wh */
            battery_wh: number | null;
            /**
             * Motor Per Rider
             * @description The motor's work over the rider's, of the moments in which both are known.
             */
            motor_per_rider: number | null;
            /**
             * Mode
             * @description Its slot.
             */
            mode: number;
            /**
             * Name
             * @description Null where nobody kept the ride's configuration.
             */
            name: string | null;
        };
        /** ModeShare */
        ModeShare: {
            /** Mode */
            mode: number;
            /**
             * Name
             * @description Null where nobody kept the ride's configuration.
             */
            name: string | null;
            /** Law */
            law: ("off" | "fixed" | "fuzzy") | null;
            /** Seconds */
            seconds: number;
            /** Motor Wh */
            motor_wh: number | null;
            /**
             * Share
             * @description Of the ride's motor energy, 0 to 1.
             */
            share: number | null;
        };
        /**
         * Needed
         * @description Where the energy of the legs went, in joules; each but gravity can be negative. drivetrain_j:
         *     lost from crank to road.
         */
        Needed: {
            /** Gravity J */
            gravity_j: number;
            /** Kinetic J */
            kinetic_j: number;
            /** Rolling J */
            rolling_j: number;
            /** Air J */
            air_j: number;
            /** Drivetrain J */
            drivetrain_j: number;
        };
        /**
         * NewApiKey
         * @description The only answer that holds a key itself.
         */
        NewApiKey: {
            key: components["schemas"]["ApiKey"];
            /**
             * Secret
             * @description What a program sends after `Authorization: Bearer`.
             */
            secret: string;
        };
        /**
         * NewPasskeyChallenge
         * @description What an authenticator is given to make a passkey.
         */
        NewPasskeyChallenge: {
            /**
             * Challenge
             * @description Random bytes, for one answer.
             */
            challenge: string;
            /**
             * Rp Id
             * @description The name of this server that the passkey will be for.
             */
            rp_id: string;
            /**
             * User Handle
             * @description Stands for the account and says nothing of it.
             */
            user_handle: string;
            /** User Name */
            user_name: string;
            /**
             * Algorithms
             * @description COSE numbers of the signatures that are understood, the preferred one first.
             */
            algorithms: number[];
            /**
             * Known
             * @description Ids of the account's credentials for this name: an authenticator that has one makes none.
             */
            known: string[];
            /** Valid S */
            valid_s: number;
        };
        /**
         * NewRider
         * @description An account for who has none, made with the code.
         */
        NewRider: {
            /** Name */
            name: string;
            /**
             * Password
             * Format: password
             * @description At least 8 characters, none of the commonest; no other rule.
             */
            password: string;
        };
        /**
         * Offer
         * @description What a code gives.
         */
        Offer: {
            /** Bike Name */
            bike_name: string;
            /** Model */
            model: string | null;
            /**
             * Expires At
             * Format: date-time
             */
            expires_at: string;
        };
        /**
         * OfferedChannel
         * @description What an owner can say that a column is.
         */
        OfferedChannel: {
            /** Name */
            name: string;
            /** Unit */
            unit: string;
            /**
             * Units
             * @description In which its numbers may be, where that is never taken for granted.
             * @default []
             */
            units: string[];
        };
        /** OwnPassword */
        OwnPassword: {
            /**
             * Old
             * Format: password
             */
            old: string;
            /**
             * New
             * Format: password
             * @description At least 8 characters, none of the commonest; no other rule.
             */
            new: string;
        };
        /**
         * OwnPasswordOnly
         * @description Whoever finds an open browser must not leave a way in behind.
         */
        OwnPasswordOnly: {
            /**
             * Password
             * Format: password
             */
            password: string;
        };
        /**
         * Pairing
         * @description The only answer that holds the code.
         */
        Pairing: {
            /**
             * Code
             * @description `XXXX-XXXX`: whoever enters it first owns the bike.
             */
            code: string;
            /**
             * Expires At
             * Format: date-time
             */
            expires_at: string;
            /**
             * Link
             * @description Where it is entered, by the address this server was reached at.
             */
            link: string;
            /**
             * Qr
             * @description The link as an image, a `data:` address of an SVG.
             */
            qr: string;
        };
        /** PairingIn */
        PairingIn: {
            /**
             * Owned From
             * @description Since when the bike is theirs: rides of it from then on become theirs, too. From the moment the code is taken if null.
             */
            owned_from?: string | null;
        };
        /**
         * Parameter
         * @description What a parameter is, and its value in the unit now.
         *
         *     `min`, `max` and `choices` are the unit's own bounds. Choices are in lower case, but for the
         *     labels of rules, NB NS ZO PS PB; they are taken in any case. `may_be_none`: `null` is a value, a
         *     correction that is not known. `of_the_unit`: measured or set for this one unit and its bike, as
         *     the sensor's calibration and the wheel, so no part of a set-up for another one.
         */
        Parameter: {
            /** Id */
            id: number;
            /** Name */
            name: string;
            /** Group */
            group: string;
            /** Type */
            type: string;
            /** Shape */
            shape: number[];
            /** Unit */
            unit: string;
            /** Min */
            min: number | null;
            /** Max */
            max: number | null;
            /** Default */
            default: number | string | (number | string)[] | (number | string)[][] | null;
            /**
             * Access
             * @enum {string}
             */
            access: "rider" | "dealer" | "factory";
            /** Choices */
            choices: string[] | null;
            /** Length */
            length: number | null;
            /** Description */
            description: string;
            /**
             * May Be None
             * @default false
             */
            may_be_none: boolean;
            /**
             * Of The Unit
             * @default false
             */
            of_the_unit: boolean;
            /** Value */
            value: number | string | (number | string)[] | (number | string)[][] | null;
            /** @description Only of parameters that are held near the factory's value. */
            free: components["schemas"]["Free"] | null;
        };
        /**
         * ParameterChange
         * @description One parameter that became another.
         */
        ParameterChange: {
            /** Name */
            name: string;
            /** Old */
            old: number | string | (number | string)[] | (number | string)[][] | null;
            /** New */
            new: number | string | (number | string)[] | (number | string)[][] | null;
        };
        /** ParameterList */
        ParameterList: {
            /** Items */
            items: components["schemas"]["Parameter"][];
            /** Next */
            next: string | null;
        };
        /**
         * Passkey
         * @description One of a person's passkeys, without its key.
         */
        Passkey: {
            /** Id */
            id: number;
            /** Name */
            name: string;
            /**
             * Rp Id
             * @description The name of this server that it is for.
             */
            rp_id: string;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /** Used At */
            used_at: string | null;
        };
        /**
         * PasskeyChallenge
         * @description What a passkey that is there has to sign.
         */
        PasskeyChallenge: {
            /**
             * Challenge
             * @description Random bytes, for one answer.
             */
            challenge: string;
            /**
             * Rp Id
             * @description The name of this server that the passkey is for.
             */
            rp_id: string;
            /** Valid S */
            valid_s: number;
        };
        /**
         * PasskeyIn
         * @description What an authenticator made, and what it is called.
         */
        PasskeyIn: {
            /** Name */
            name: string;
            /**
             * Client Data
             * @description `clientDataJSON`.
             */
            client_data: string;
            /**
             * Attestation
             * @description `attestationObject`; `none` is enough.
             */
            attestation: string;
        };
        /**
         * PasskeyProof
         * @description What an authenticator signed.
         */
        PasskeyProof: {
            /** Credential Id */
            credential_id: string;
            /**
             * Client Data
             * @description `clientDataJSON`.
             */
            client_data: string;
            /** Authenticator Data */
            authenticator_data: string;
            /** Signature */
            signature: string;
            /** User Handle */
            user_handle: string;
        };
        /** Passkeys */
        Passkeys: {
            /** Items */
            items: components["schemas"]["Passkey"][];
        };
        /**
         * Past
         * @description An earlier calibration. *_expanded: k = 2.
         */
        Past: {
            /** At Utc Us */
            at_utc_us: number;
            /** Offset Counts */
            offset_counts: number;
            /** Offset Expanded */
            offset_expanded: number;
            /** Gain Nm Per Count */
            gain_nm_per_count: number;
            /** Gain Expanded */
            gain_expanded: number;
        };
        /**
         * Pause
         * @description The timer of the device that recorded stood.
         */
        Pause: {
            /** From S */
            from_s: number;
            /** To S */
            to_s: number;
            /**
             * By Rider
             * @description False when the device stopped by itself.
             */
            by_rider: boolean | null;
        };
        /** People */
        People: {
            /** Items */
            items: components["schemas"]["Person"][];
        };
        /**
         * PeriodTotals
         * @description A week or a month in the rider's time zone: [from, to).
         */
        PeriodTotals: {
            /** Rides */
            rides: number;
            /** With Rider */
            with_rider: number;
            /** With Motor */
            with_motor: number;
            /** Distance Km */
            distance_km: number | null;
            /** Moving S */
            moving_s: number | null;
            /** Rider Wh */
            rider_wh: number | null;
            /** Rider Power W Mean */
            rider_power_w_mean: number | null;
            /** Motor Wh */
            motor_wh: number | null;
            /**
             * First Day
             * Format: date
             */
            first_day: string;
            /**
             * From
             * Format: date-time
             */
            from: string;
            /**
             * To
             * Format: date-time
             */
            to: string;
        };
        /**
         * Permission
         * @description One thing that may be allowed.
         * @enum {string}
         */
        Permission: "compute" | "see_bikes" | "change_bikes" | "calibrate" | "see_register" | "change_register" | "see_rides" | "change_rides" | "upload_files" | "see_library" | "change_library" | "simulate" | "see_server" | "back_up" | "see_audit" | "manage_people";
        /**
         * Person
         * @description An account.
         */
        Person: {
            /** Id */
            id: number;
            /**
             * Name
             * @description Unique whatever its case, and what changes are signed with.
             */
            name: string;
            /**
             * Role
             * @enum {string}
             */
            role: "rider" | "dealer" | "engineer" | "admin";
            /** Enabled */
            enabled: boolean;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /**
             * Signed In At
             * @description When last.
             */
            signed_in_at: string | null;
        };
        /**
         * PersonChange
         * @description What is absent stays.
         */
        PersonChange: {
            /** Name */
            name?: string | null;
            /** Role */
            role?: ("rider" | "dealer" | "engineer" | "admin") | null;
            /** Enabled */
            enabled?: boolean | null;
            /** Password */
            password?: string | null;
        };
        /** PersonIn */
        PersonIn: {
            /** Name */
            name: string;
            /**
             * Password
             * Format: password
             * @description At least 8 characters, none of the commonest; no other rule.
             */
            password: string;
            /**
             * Role
             * @enum {string}
             */
            role: "rider" | "dealer" | "engineer" | "admin";
        };
        /**
         * Piecewise
         * @description To be added to a reading: correction_nm at reading_nm (k,), ascending; standard_nm of each.
         *
         *     significant: the largest correction is beyond twice its own standard uncertainty.
         */
        Piecewise: {
            /** Reading Nm */
            reading_nm: number[];
            /** Correction Nm */
            correction_nm: number[];
            /** Standard Nm */
            standard_nm: number[];
            /** Significant */
            significant: boolean;
        };
        /** PointGains */
        PointGains: {
            /** Gain */
            gain: number[];
            /** Engine */
            engine: string;
        };
        /** PointsRequest */
        PointsRequest: {
            fuzzy_table: components["schemas"]["FuzzyTable"];
            /**
             * Points
             * @description Pairs of speed_kmh and torque_rate.
             */
            points: [
                number,
                number
            ][];
        };
        /**
         * Port
         * @description A place where a unit may be: pass `url` to `POST /devices`.
         */
        Port: {
            /** Url */
            url: string;
            /**
             * Kind
             * @enum {string}
             */
            kind: "simulated" | "serial" | "socket";
            /**
             * Description
             * @description In the adapter's own words.
             */
            description: string;
            /** Manufacturer */
            manufacturer: string | null;
            /** Usb Vendor Id */
            usb_vendor_id: number | null;
            /** Usb Product Id */
            usb_product_id: number | null;
            /**
             * Usb Serial Number
             * @description Finds the same adapter again under a new name.
             */
            usb_serial_number: string | null;
            /**
             * In Use
             * @description null where it is unknown without opening it.
             */
            in_use: boolean | null;
            /**
             * Hint
             * @description What stands in the way and what to do about it.
             */
            hint: string | null;
            /**
             * Hint Code
             * @description A word for the hint: `port_permission` or `port_busy`, as a device's `reason_code`.
             */
            hint_code: string | null;
        };
        /** PortList */
        PortList: {
            /** Items */
            items: components["schemas"]["Port"][];
            /** Next */
            next: string | null;
        };
        /**
         * Proposal
         * @description A job and what it found: `done` with candidates by how much they gain, `failed` with why.
         */
        Proposal: {
            /** Id */
            id: string;
            /**
             * State
             * @enum {string}
             */
            state: "waiting" | "riding" | "proving" | "done" | "failed" | "cancelled";
            /**
             * Objective
             * @enum {string}
             */
            objective: "more_range" | "gentler_start" | "flatter_at_the_limit";
            /** Target Pct */
            target_pct: number;
            /**
             * Knobs
             * @description Those that do something on these rides.
             */
            knobs: ("ratio" | "band" | "filter" | "torque_rate" | "cells")[];
            /** Ride Ids */
            ride_ids: number[];
            /**
             * Config Source
             * @enum {string}
             */
            config_source: "ride" | "defaults";
            /**
             * Aim Before
             * @description What the wish is measured by, as it is now: Wh/km of the battery, or Nm/s rms at the crank.
             */
            aim_before: number;
            /** Progress */
            progress: number;
            /** Rides Ridden */
            rides_ridden: number;
            /** Seconds */
            seconds: number;
            /** Code */
            code: string | null;
            /** Detail */
            detail: string | null;
            /** Candidates */
            candidates: components["schemas"]["ProposalCandidate"][];
        };
        /**
         * ProposalCandidate
         * @description Settings that were found. The linter has no doubt of them that it has not of what is set
         *     now, and their limit proof holds.
         */
        ProposalCandidate: {
            /**
             * Gained Pct
             * @description More range, or less of what is felt, by the twin.
             */
            gained_pct: number;
            /** Meets Target */
            meets_target: boolean;
            /** Recommended */
            recommended: boolean;
            battery_wh_per_km: components["schemas"]["ProposalFigure"];
            duration_s: components["schemas"]["ProposalFigure"];
            /** Parameters */
            parameters: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
            /** Changed */
            changed: components["schemas"]["ParameterChange"][];
            /** Limit Proof Sha256 */
            limit_proof_sha256: string;
            /** @description The same, as `POST /library` takes it. */
            document: components["schemas"]["LibraryEntry"];
        };
        /**
         * ProposalFigure
         * @description Of all rides, as recorded and with the settings, as `POST /rides/{id}/again` tells them; nine
         *     of ten simulated rides lay between `low` and `high`.
         */
        ProposalFigure: {
            /** Before */
            before: number;
            /** After */
            after: number;
            /** Low */
            low: number;
            /** High */
            high: number;
        };
        /**
         * ProposalRequest
         * @description A wish, the rides it is measured on, and what may be turned for it.
         */
        ProposalRequest: {
            /** Ride Ids */
            ride_ids: number[];
            /**
             * Objective
             * @enum {string}
             */
            objective: "more_range" | "gentler_start" | "flatter_at_the_limit";
            /**
             * Knobs
             * @description `ratio` of the ridden modes, `band` below the cut-off speed, `filter` of the torque, `torque_rate` points as a whole, `cells` of the table as monotone steps.
             */
            knobs?: ("ratio" | "band" | "filter" | "torque_rate" | "cells")[];
            /**
             * Target Pct
             * @description How much more range, or how much less of what is to be gentler or flatter; 10 or 20 without it.
             */
            target_pct?: number | null;
            /** Mass Kg */
            mass_kg?: number | null;
            /** Drag Area M2 */
            drag_area_m2?: number | null;
        };
        /**
         * PulseComparison
         * @description The speed sensor's pulses in a turn of its wheel, compared with the unit's setting.
         */
        PulseComparison: {
            /**
             * Unit Key
             * @description Whose they are.
             */
            unit_key: string | null;
            /**
             * Reported Turns
             * @description Of the wheel, by the unit.
             */
            reported_turns: number;
            /** Turns */
            turns: number;
            pulses: components["schemas"]["Pulses"];
        };
        /**
         * Pulses
         * @description A wheel's pulses in a turn. stored: what the unit counts with. counted, expanded: what its
         *     distance comes to, k = 2. nearest_integer: the number within that; None where there is none: the
         *     turns were miscounted, or a magnet is missed. agrees: the stored one is within.
         */
        Pulses: {
            /** Stored */
            stored: number;
            /** Counted */
            counted: number;
            /** Expanded */
            expanded: number;
            /** Nearest Integer */
            nearest_integer: number | null;
            /** Agrees */
            agrees: boolean;
        };
        /**
         * PulsesRequest
         * @description A ride, or a part of it, in which nothing but a hand turned the wheel, from a mark to it.
         */
        PulsesRequest: {
            /** Ride Id */
            ride_id: number;
            /** From S */
            from_s?: number | null;
            /** To S */
            to_s?: number | null;
            /**
             * Turns
             * @description Of the wheel, counted by whoever turned it.
             */
            turns: number;
        };
        /**
         * ReadFis
         * @description What a file holds; nothing of it is kept until it is posted to `/library`.
         */
        ReadFis: {
            document: components["schemas"]["LibraryEntry"];
            fuzzy_table: components["schemas"]["FuzzyTable"];
            deviation: components["schemas"]["Deviation"];
        };
        /**
         * Reading
         * @description The sensor now; null where nothing comes.
         */
        Reading: {
            /** Device Id */
            device_id: string | null;
            /** Steady */
            steady: boolean;
            /**
             * Steady S
             * @description For how long a capture could have been taken.
             */
            steady_s: number;
            /**
             * Reasons
             * @description Why it may not be captured.
             */
            reasons: components["schemas"]["Refusal"][];
            /**
             * T S
             * @description Unit time before the newest row, thinned with `raw_counts`.
             */
            t_s: number[];
            /** Raw Counts */
            raw_counts: (number | null)[];
            /** Mean Counts */
            mean_counts: number | null;
            /** Deviation Counts */
            deviation_counts: number | null;
            /**
             * Spread Counts
             * @description Of the means of its quarter seconds.
             */
            spread_counts: number | null;
            /** Spread Allowed Counts */
            spread_allowed_counts: number | null;
            /** Window S */
            window_s: number;
            /**
             * Found Nm
             * @description Of the steady window by the coefficients that the unit had.
             */
            found_nm: number | null;
            /** Fitted Nm */
            fitted_nm: number | null;
            /** Unit Nm */
            unit_nm: number | null;
            /** Sensor Degc */
            sensor_degc: number | null;
            /** Cadence Rpm */
            cadence_rpm: number | null;
            /** Speed Kmh */
            speed_kmh: number | null;
            /** Checks */
            checks: components["schemas"]["Check"][];
        };
        /**
         * RecordChange
         * @description A change of the unit's record that was read back.
         */
        RecordChange: {
            /**
             * Kind
             * @enum {string}
             */
            kind: "write" | "restore";
            /**
             * At
             * Format: date-time
             */
            at: string;
            /** Author */
            author: string;
            /** Reason */
            reason: string;
            /**
             * Record
             * @description What it has since.
             */
            record: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
            /** Before */
            before: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
            /**
             * Generation
             * @description Of the unit's configuration.
             */
            generation: number;
            /** Certificate Sha256 */
            certificate_sha256: string | null;
        };
        /**
         * RecordLine
         * @description A parameter of the unit's record: as it was found, and as `write` makes it.
         */
        RecordLine: {
            /** Name */
            name: string;
            /** Found */
            found: number | string | (number | string)[] | (number | string)[][] | null;
            /** Planned */
            planned: number | string | (number | string)[] | (number | string)[][] | null;
            /**
             * Free Min
             * @description From here to `free_max` it needs no token.
             */
            free_min: number | null;
            /** Free Max */
            free_max: number | null;
            /**
             * Beyond
             * @description Whether the new value needs the maker's token.
             */
            beyond: boolean;
        };
        /**
         * RecorderHealth
         * @description Rows of rides since the server started.
         */
        RecorderHealth: {
            /**
             * Rows Saved
             * @description Committed in the store.
             * @default 0
             */
            rows_saved: number;
            /**
             * Rows Lost
             * @description Given up, because the store refused them too long.
             * @default 0
             */
            rows_lost: number;
            /**
             * Rows Waiting
             * @description On the way to the store, or waiting for it.
             * @default 0
             */
            rows_waiting: number;
            /**
             * Rows Missing
             * @description Never came while the bike was ridden: gaps of its rides. None of the others.
             * @default 0
             */
            rows_missing: number;
        };
        /**
         * Refusal
         * @description figure: the number that decides, in the unit the code implies; None where it is no number.
         *
         *     values: what the sentence tells besides, by name, for a text in another language. captures:
         *     the numbers of those at fault.
         */
        Refusal: {
            /** Code */
            code: string;
            /** Sentence */
            sentence: string;
            /** Figure */
            figure?: number | null;
            /** Values */
            values?: {
                [key: string]: number | string;
            };
            /**
             * Captures
             * @default []
             */
            captures: number[];
        };
        /**
         * Replay
         * @description What the motor would have done with other settings, beside what it did.
         *
         *     `series` has each compared channel as recorded, and as replayed under `replayed_` and its name.
         *     `limit_shares`: part of the samples, 0 to 1, in which each limit of the registry held the motor
         *     back.
         */
        Replay: {
            /** Ride Id */
            ride_id: number;
            /**
             * Mode
             * @constant
             */
            mode: "open_loop";
            /**
             * Meaning
             * @description What the open loop leaves out, in English.
             */
            meaning: string;
            /**
             * Config Source
             * @description Whose parameters the rest of the law ran with.
             * @enum {string}
             */
            config_source: "ride" | "defaults";
            /** Engine */
            engine: string;
            /**
             * Inputs Missing
             * @description Channels of the law's inputs that the ride lacks. Without `input_flags` the brake is off, the walk button not held and no fault forbids torque; without `torque_age_ms` the torque is fresh, without `controller_temperature_degc` the controller cool, without `motor_temperature_degc` the motor hot for the battery's limit; without `motor_speed_rpm` the motor follows the crank.
             */
            inputs_missing: string[];
            /** Rows */
            rows: number;
            /**
             * Motor Torque Meaning
             * @description What the recorded motor torque is; where it is only `demanded`, there is no recorded work.
             */
            motor_torque_meaning: ("demanded" | "delivered") | null;
            /** @description Work at the motor's shaft for a kilometre, the figure to compare by; null where the ride went less than 10 m. */
            wh_per_km: components["schemas"]["Compared"] | null;
            /**
             * Distance Km
             * @description As recorded.
             */
            distance_km: number;
            /**
             * Duration S
             * @description As recorded: in open loop the road takes as long.
             */
            duration_s: number;
            /**
             * Range Km
             * @description Null in open loop: shaft work is not what leaves the battery.
             */
            range_km: number | null;
            motor_work_wh: components["schemas"]["Compared"];
            /** @description At the motor's shaft, as delivered; nothing is recorded where it is only `demanded`. */
            motor_torque_nm_max: components["schemas"]["Compared"];
            /** @description At the shaft, while the bike moves; null where it never does. */
            motor_power_w_mean: components["schemas"]["Compared"] | null;
            /** @description Rms of how fast the motor's torque changes, while the bike moves; null as `motor_power_w_mean`. */
            ripple_nm_per_s: components["schemas"]["Compared"] | null;
            /** Motor Torque Nm Difference Max */
            motor_torque_nm_difference_max: number | null;
            /** Limit Shares */
            limit_shares: {
                [key: string]: number;
            };
            /**
             * Limit Shares Recorded
             * @description The same as the unit told it on the ride; null where it did not.
             */
            limit_shares_recorded: {
                [key: string]: number;
            } | null;
            series: components["schemas"]["Series"];
        };
        /** ReplayRequest */
        ReplayRequest: {
            /**
             * Parameters
             * @description By registry name, as a unit's configuration or an entry of the library has them. Those of sensor, wheel and drivetrain stay as they were on the ride.
             */
            parameters?: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
            fuzzy_table?: components["schemas"]["FuzzyTable"] | null;
            /** @description Shares speed and torque-rate points with the first. */
            second_table?: components["schemas"]["FuzzyTable"] | null;
            assist_modes?: components["schemas"]["AssistModes"] | null;
            /**
             * Mode
             * @default open_loop
             * @constant
             */
            mode: "open_loop";
        };
        /**
         * Residual
         * @description Of one capture: what the coefficients read there, and how much that is above the load.
         */
        Residual: {
            /** Capture */
            capture: number;
            /** Load Nm */
            load_nm: number;
            /** Reading Nm */
            reading_nm: number;
            /** Residual Nm */
            residual_nm: number;
        };
        /**
         * Resistance
         * @description rolling_n: at any speed. air_ns2_m2: times the square of the speed. covariance: of the two,
         *     from the scatter of the runs about the model. source: `typical` of no runs.
         */
        Resistance: {
            /** Rolling N */
            rolling_n: number;
            /** Air Ns2 M2 */
            air_ns2_m2: number;
            /** Covariance */
            covariance: [
                [
                    number,
                    number
                ],
                [
                    number,
                    number
                ]
            ];
            /**
             * Source
             * @default coast_down
             * @enum {string}
             */
            source: "coast_down" | "typical";
        };
        /**
         * Result
         * @description What a job came to; null without a fit.
         */
        Result: {
            /** Verdict */
            verdict: ("pass" | "conditional" | "fail") | null;
            /** @description Its coefficients with their uncertainty. */
            past: components["schemas"]["Past"] | null;
            /**
             * Expanded Nm
             * @description The largest of the budget, k = 2.
             */
            expanded_nm: number | null;
            /**
             * Linearity Pct
             * @description To the line, the worse side.
             */
            linearity_pct: number | null;
            /** Hysteresis Pct */
            hysteresis_pct: number | null;
            /**
             * Verified
             * @default false
             */
            verified: boolean;
            /** Certificate Sha256 */
            certificate_sha256: string | null;
        };
        /**
         * Revision
         * @description Who changed what, when and why.
         */
        Revision: {
            /**
             * Seq
             * @description Counts the configurations of one unit from 1.
             */
            seq: number;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /**
             * Author
             * @description Empty where nobody knows.
             */
            author: string;
            /**
             * Author Proof
             * @description How the author is known: `stated` is by their own word, `signed_in` by an account or a key.
             */
            author_proof: ("stated" | "signed_in") | null;
            /** Reason */
            reason: string;
            /** State */
            state: string;
            /** Generation */
            generation: number | null;
            /** Crc32 */
            crc32: number | null;
            /** Changed */
            changed: components["schemas"]["ParameterChange"][];
            /**
             * Unit Key
             * @description Whose configuration it was, over whatever connection.
             */
            unit_key: string;
        };
        /** RevisionList */
        RevisionList: {
            /** Items */
            items: components["schemas"]["Revision"][];
            /** Next */
            next: string | null;
        };
        /** Ride */
        Ride: {
            /** Id */
            id: number;
            /**
             * State
             * @enum {string}
             */
            state: "live" | "closing" | "done" | "bad";
            /**
             * Origin
             * @enum {string}
             */
            origin: "recorded" | "imported";
            /** Name */
            name: string;
            /** Notes */
            notes: string;
            /**
             * Started At
             * Format: date-time
             */
            started_at: string;
            /** Row Count */
            row_count: number;
            /**
             * Period Us
             * @description Spacing of the rows; null when irregular.
             */
            period_us: number | null;
            /** Channels */
            channels: components["schemas"]["RideChannel"][];
            /**
             * Motor Torque Meaning
             * @description What `motor_torque_nm` of this ride is: what the motor gave, by its current; or only what was asked of it, as units of firmware before `motor_torque_demanded_nm` and most files have it. Null without that channel. The two are not compared or added.
             */
            motor_torque_meaning: ("demanded" | "delivered") | null;
            /**
             * Unit Key
             * @description The unit it was made with; null where nobody knows.
             */
            unit_key: string | null;
            /**
             * Bike Id
             * @description The bike that unit was on; null where nobody knows.
             */
            bike_id: number | null;
            /**
             * Owner Id
             * @description The account whose ride it is: its bike's owner when it began, or who sent the file, if that is a rider. Null for nobody's.
             */
            owner_id: number | null;
            device: components["schemas"]["RideDevice"];
            /** Gaps */
            gaps: components["schemas"]["Gap"][];
            /** Filled */
            filled: components["schemas"]["Filled"][];
            /** Events */
            events: components["schemas"]["RideEvent"][];
            /**
             * Completeness
             * @description Share of the rows that should be there, 0 to 1; what was filled from a log counts as there. Null when nobody can say.
             */
            completeness: number | null;
            /**
             * Cut Short
             * @description The recording ended while the bike moved, or with the server that recorded it: nobody knows what came after the last row. False for a ride that stood still at its end, was imported, is still being recorded, or was filled from the unit's own log since.
             */
            cut_short: boolean;
            /**
             * Sport
             * @description As the file calls it; null for none.
             */
            sport: string | null;
            /** @description What became of the file's rows and fields; null for a ride that was recorded here, and for one that was read before this was counted. */
            intake: components["schemas"]["Intake"] | null;
            /**
             * Laps
             * @description As the file tells them; empty for none.
             */
            laps: components["schemas"]["Lap"][];
            /**
             * Pauses
             * @description Of the timer of the device that recorded.
             */
            pauses: components["schemas"]["Pause"][];
            /**
             * Instruments
             * @description What recorded the file's ride.
             */
            instruments: components["schemas"]["Instrument"][];
            /**
             * Statements
             * @description What that device stated of the whole ride; a session of several rides is with each. Never mixed with `summary`, which is of the ride's own rows.
             */
            statements: components["schemas"]["DeviceSession"][];
            /** Upload Id */
            upload_id: string | null;
            /** Object Bytes */
            object_bytes: number | null;
            /**
             * Damage
             * @description What is wrong with the file of its samples, as far as it was looked at; then series, figure, replay and exports answer 500 `object_damaged`. The figures here stay. `row`, with the state `bad`: its row in the database is damaged, so nothing but number, start, name and notes is known until it is mended from that file, by itself.
             */
            damage: ("missing" | "wrong_size" | "changed" | "unreadable" | "row") | null;
            /** @description Of a ride that is being recorded: so far, where this server records it. */
            summary: components["schemas"]["RideSummary"] | null;
            /**
             * Same Ride As
             * @description Another device's recording of the same ride, which is kept beside it.
             */
            same_ride_as: number | null;
            /**
             * Outdone
             * @description A better recording of the same ride counts in sums and records in its place.
             */
            outdone: boolean;
            /** Tags */
            tags: string[];
            /** @description Null without positions, and until a moment after the ride came. */
            place: components["schemas"]["RidePlace"] | null;
            /**
             * Speed Line Kmh
             * @description Mean speeds over 64 equal times; empty without a speed.
             */
            speed_line_kmh: (number | null)[];
            /**
             * Doubts
             * @description Figures that disagree or cannot be. The ride is in no record until somebody accepts them. Empty until a moment after the ride came.
             */
            doubts: components["schemas"]["Doubt"][];
        };
        /**
         * RideChannel
         * @description A channel that can be asked for; `derived` ones are computed from recorded ones.
         */
        RideChannel: {
            /** Name */
            name: string;
            /** Unit */
            unit: string;
            /** Scale */
            scale: number;
            /** Derived */
            derived: boolean;
        };
        /** RideComparison */
        RideComparison: {
            a: components["schemas"]["ComparedSide"];
            b: components["schemas"]["ComparedSide"];
            /** Figures */
            figures: components["schemas"]["ComparedFigure"][];
            /**
             * Motor Torque
             * @description `apart`: one ride tells what the motor gave, the other what was asked of it.
             * @enum {string}
             */
            motor_torque: "alike" | "apart";
            /** Channels */
            channels: components["schemas"]["ComparedChannel"][];
            route_overlap: components["schemas"]["RouteOverlap"] | null;
            /**
             * No Route
             * @description Who has no positions, or too few of them; null with `route_overlap`.
             */
            no_route: ("a" | "b" | "neither" | "too_few") | null;
            settings: components["schemas"]["SettingsDifference"];
        };
        /**
         * RideCurve
         * @description Means over each stretch of the road, null where there is no sample.
         */
        RideCurve: {
            /**
             * T S
             * @description Since the ride's own start.
             */
            t_s: (number | null)[];
            /** Speed Kmh */
            speed_kmh: (number | null)[];
            /**
             * Motor Torque Nm
             * @description At the motor's shaft.
             */
            motor_torque_nm: (number | null)[];
        };
        /**
         * RideCurves
         * @description The same road three times: as recorded, by the twin without any change, and with it.
         */
        RideCurves: {
            /**
             * Distance Km
             * @description Middle of each stretch; at most 400, none shorter than a turn of the crank.
             */
            distance_km: number[];
            recorded: components["schemas"]["RideCurve"];
            unchanged: components["schemas"]["RideCurve"];
            replayed: components["schemas"]["RideCurve"];
        };
        /**
         * RideDevice
         * @description What was true of the bike while the ride was made; null where unknown.
         */
        RideDevice: {
            /**
             * Device Id
             * @description The connection it was recorded over.
             */
            device_id: string | null;
            /** Device Serial */
            device_serial: string | null;
            /** Device Model */
            device_model: string | null;
            /** Firmware Version */
            firmware_version: string | null;
            /** Config Generation */
            config_generation: number | null;
            /** Config Crc32 */
            config_crc32: number | null;
            /** Gear Ratio */
            gear_ratio: number | null;
        };
        /** RideDiagnosis */
        RideDiagnosis: {
            /** Ride Id */
            ride_id: number;
            /**
             * Method
             * @description Counted up whenever a threshold or a method changes.
             */
            method: number;
            /** Worst */
            worst: ("note" | "warning" | "serious") | null;
            /** Checks */
            checks: components["schemas"]["DiagnosisCheck"][];
        };
        /**
         * RideEffort
         * @description What the rider gave; null without the channel.
         */
        RideEffort: {
            /** Ride Id */
            ride_id: number;
            /** @description While pedalling. Zones after Allen and Coggan, of the threshold power. */
            power: components["schemas"]["Distribution"] | null;
            /** @description Zones by tenths of the greatest. */
            heart_rate: components["schemas"]["Distribution"] | null;
            torque: components["schemas"]["Distribution"] | null;
            /**
             * Torque Of Power
             * @description Torque is power over cadence, not measured.
             */
            torque_of_power: boolean;
            cadence: components["schemas"]["Distribution"] | null;
            /**
             * Power Curve
             * @description A stretch with a gap in it does not count; the last is the longest without.
             */
            power_curve: components["schemas"]["BestMean"][];
            /** Laps */
            laps: components["schemas"]["LapFigures"][];
        };
        /** RideEnergy */
        RideEnergy: {
            /** Ride Id */
            ride_id: number;
            total: components["schemas"]["EnergyShare"];
            /**
             * Lost Km
             * @description Way in gaps, that is in no row.
             */
            lost_km: number | null;
            /** Battery Wh Per Km */
            battery_wh_per_km: number | null;
            /** Modes */
            modes: components["schemas"]["ModeEnergy"][];
            /**
             * Gradients
             * @description Gradient of height over way, a straight line over 100 m; null without heights.
             */
            gradients: components["schemas"]["GradientEnergy"][] | null;
            /** Gradient Unknown S */
            gradient_unknown_s: number | null;
            climb: components["schemas"]["Climb"] | null;
            charge: components["schemas"]["Charge"] | null;
            /**
             * Range Refused
             * @description Why there is no range; null with one.
             */
            range_refused: "no_charge" | ("no_distance" | "short_way" | "charged" | "little_used") | null;
        };
        /**
         * RideEvent
         * @description A fault that came or went (value: bits of `fault_flags`), the mode chosen (its slot),
         *     settings that came into force (CRC-32 of the configuration), a moment that somebody marked (its
         *     number), or the host's clock set in mid-ride (by how many milliseconds, negative for back; the
         *     ride is dated by the clock as it was set).
         */
        RideEvent: {
            /** T S */
            t_s: number;
            /**
             * Kind
             * @description The first `assist_mode` is the mode the ride began in.
             * @enum {string}
             */
            kind: "fault_set" | "fault_cleared" | "assist_mode" | "settings" | "mark" | "clock_set";
            /** Value */
            value: number;
        };
        /**
         * RideFault
         * @description Faults that came on a ride.
         */
        RideFault: {
            /** Ride Id */
            ride_id: number;
            /**
             * At
             * Format: date-time
             */
            at: string;
            /**
             * Flags
             * @description Bits of `fault_flags`.
             */
            flags: number;
        };
        /** RideList */
        RideList: {
            /** Items */
            items: components["schemas"]["Ride"][];
            /** Next */
            next: string | null;
            /**
             * Total
             * @description Rides of this kind in all; with the first page only.
             */
            total: number | null;
        };
        /**
         * RideMark
         * @description A moment that was marked, t_s seconds after the start of its ride.
         */
        RideMark: {
            /** Ride Id */
            ride_id: number;
            /** T S */
            t_s: number;
            /**
             * Number
             * @description From 1, in its ride.
             */
            number: number;
        };
        /** RidePatch */
        RidePatch: {
            /** Name */
            name?: string | null;
            /** Notes */
            notes?: string | null;
            /**
             * Tags
             * @description All of them, anew.
             */
            tags?: string[] | null;
            /**
             * Doubts Accepted
             * @description Whether somebody accepts all that is doubtful of the ride.
             */
            doubts_accepted?: boolean | null;
        };
        /** RidePedalling */
        RidePedalling: {
            /** Ride Id */
            ride_id: number;
            crank: components["schemas"]["CrankTorque"] | null;
            /** Crank Refused */
            crank_refused: ("no_angle" | "no_torque" | "slow_rows" | "few_turns") | null;
            gain: components["schemas"]["GainMap"] | null;
            /**
             * Speed Points Kmh
             * @description Of the ride's own table; null where nobody kept it.
             */
            speed_points_kmh: number[] | null;
            /** Gain Points */
            gain_points: number[] | null;
        };
        /**
         * RidePlace
         * @description Where a ride began: the nearest town of GeoNames. Null for what is unknown.
         */
        RidePlace: {
            /**
             * Name
             * @description The nearest town's.
             */
            name: string | null;
            /**
             * Country
             * @description ISO 3166 code of two letters.
             */
            country: string | null;
            /**
             * Zone
             * @description Of the IANA database: local times are in it.
             */
            zone: string | null;
            /**
             * Is Loop
             * @description It ended where it began.
             */
            is_loop: boolean | null;
        };
        /**
         * RideRecord
         * @description The ride that has most of a figure. Powers are the rider's own.
         */
        RideRecord: {
            /**
             * Kind
             * @enum {string}
             */
            kind: "distance_km" | "speed_kmh_mean" | "ascent_m" | "power_w_best_5s" | "power_w_best_60s" | "power_w_best_300s" | "power_w_best_1200s";
            /** Value */
            value: number;
            /** Ride Id */
            ride_id: number;
            /**
             * Started At
             * Format: date-time
             */
            started_at: string;
        };
        /**
         * RideSummary
         * @description What a ride comes to; null where the ride lacks the channel.
         *
         *     Rider and motor energy are never added up. `*_excluded_s` is time without the channel. The
         *     motor's energy and power are of the torque it delivered: null where the ride's
         *     `motor_torque_meaning` is `demanded`, unless a file told the power itself.
         */
        RideSummary: {
            /** Duration S */
            duration_s: number;
            /** Moving S */
            moving_s: number | null;
            /** Distance Km */
            distance_km: number | null;
            /**
             * Distance Source
             * @description By what it was found: positions alone where there is neither odometer nor speed.
             */
            distance_source: ("odometer" | "speed" | "positions") | null;
            /** Rider Wh */
            rider_wh: number | null;
            /** Rider Excluded S */
            rider_excluded_s: number | null;
            /** Motor Wh */
            motor_wh: number | null;
            /** Motor Excluded S */
            motor_excluded_s: number | null;
            /** Battery Wh */
            battery_wh: number | null;
            /** Battery Excluded S */
            battery_excluded_s: number | null;
            /** Speed Kmh Mean */
            speed_kmh_mean: number | null;
            /** Speed Kmh Max */
            speed_kmh_max: number | null;
            /** Cadence Rpm Mean */
            cadence_rpm_mean: number | null;
            /** Cadence Rpm Max */
            cadence_rpm_max: number | null;
            /** Rider Torque Nm Mean */
            rider_torque_nm_mean: number | null;
            /** Rider Torque Nm Max */
            rider_torque_nm_max: number | null;
            /** Rider Power W Mean */
            rider_power_w_mean: number | null;
            /** Rider Power W Max */
            rider_power_w_max: number | null;
            /** Motor Torque Nm Max */
            motor_torque_nm_max: number | null;
            /** Motor Power W Mean */
            motor_power_w_mean: number | null;
            /** Motor Power W Max */
            motor_power_w_max: number | null;
            /** Battery Soc Pct Used */
            battery_soc_pct_used: number | null;
            /** Motor Temperature Degc Max */
            motor_temperature_degc_max: number | null;
        };
        /**
         * RideTags
         * @description Tags to add to rides and to take from them, all or none.
         */
        RideTags: {
            /** Ride Ids */
            ride_ids: number[];
            /**
             * Add
             * @default []
             */
            add: string[];
            /**
             * Remove
             * @default []
             */
            remove: string[];
        };
        /**
         * RideWithout
         * @description A ride that says nothing about the table, and why.
         *
         *     `missing_channel`: it lacks what the law's inputs are known by, as files of head units do.
         *     `not_assisted`: no mode gave assist by this table. `object_damaged`: its file is not as written.
         */
        RideWithout: {
            /** Id */
            id: number;
            /**
             * Code
             * @enum {string}
             */
            code: "missing_channel" | "not_assisted" | "object_damaged";
            /** Message */
            message: string;
        };
        /**
         * RideZero
         * @description A ride, and what its torque sensor read while the rider coasted.
         */
        RideZero: {
            /** Ride Id */
            ride_id: number;
            /**
             * Started At
             * Format: date-time
             */
            started_at: string;
            /**
             * Zero Nm
             * @description By the unit's scale on that ride.
             */
            zero_nm: number | null;
            /**
             * Uncertainty Nm
             * @description Standard uncertainty.
             */
            uncertainty_nm: number | null;
            /** Zero Counts */
            zero_counts: number | null;
            /**
             * Temperature Degc
             * @description Of the sensor, then.
             */
            temperature_degc: number | null;
            /**
             * Pieces
             * @description Stretches of coasting of 5 s that it is the median of.
             */
            pieces: number;
            /**
             * Reason
             * @description Why there is no zero.
             */
            reason: ("no_torque" | "no_cadence" | "no_speed" | "no_coasting" | "not_still" | "foot" | "disagree" | "unreadable") | null;
            /**
             * Left Out
             * @description Why a zero is not in the trend: far from all others; no temperature where the others have one; ridden under another temperature compensation.
             */
            left_out: ("apart" | "no_temperature" | "other_compensation") | null;
        };
        /**
         * RiderHome
         * @description Twelve weeks and twelve months up to now, the oldest first; bikes, the last ridden first.
         */
        RiderHome: {
            /** Weeks */
            weeks: components["schemas"]["PeriodTotals"][];
            /** Months */
            months: components["schemas"]["PeriodTotals"][];
            /** Bikes */
            bikes: components["schemas"]["BikeTotals"][];
            /** Records */
            records: components["schemas"]["RideRecord"][];
            /** Faults */
            faults: components["schemas"]["RideFault"][];
            /** Tags */
            tags: components["schemas"]["TagInUse"][];
        };
        /** RidesGone */
        RidesGone: {
            /** Ride Ids */
            ride_ids: number[];
        };
        /**
         * RidesTogether
         * @description What some rides of a unit come to together; null where none of them tells it.
         *
         *     Rider and motor energy are never added up: `assist_ratio` is the motor's over the rider's.
         */
        RidesTogether: {
            /**
             * Ride Ids
             * @description Newest first; at most 20, each of 500 m and more.
             */
            ride_ids: number[];
            /** Distance Km */
            distance_km: number;
            /**
             * Speed Kmh Mean
             * @description While moving.
             */
            speed_kmh_mean: number | null;
            /**
             * Motor Rides
             * @description Of the rides those whose motor work was measured.
             */
            motor_rides: number;
            /**
             * Motor Wh Per Km
             * @description Work at the motor's shaft.
             */
            motor_wh_per_km: number | null;
            /**
             * Motor Wh Per Km Least
             * @description Of one ride.
             */
            motor_wh_per_km_least: number | null;
            /** Motor Wh Per Km Most */
            motor_wh_per_km_most: number | null;
            /** Rider Wh Per Km */
            rider_wh_per_km: number | null;
            /** Battery Wh Per Km */
            battery_wh_per_km: number | null;
            /** Assist Ratio */
            assist_ratio: number | null;
        };
        /**
         * RollOut
         * @description Rolled straight ahead from one mark on the ground to the next, rider on the saddle.
         */
        RollOut: {
            /** Distances M */
            distances_m: number[];
            /**
             * Turns
             * @description Of the wheel, in each of the rolls.
             */
            turns: number;
            /**
             * Tape Limit M
             * @description Half width of what a roll may be off.
             */
            tape_limit_m: number;
            /**
             * Device Id
             * @description A connected unit to compare with; null: none.
             */
            device_id?: string | null;
        };
        /**
         * RouteOverlap
         * @description Shares, 0 to 1, of tracks walked in steps of 10 m.
         */
        RouteOverlap: {
            /** Near M */
            near_m: number;
            /**
             * A Near B
             * @description Of A's track, so near to B's, whenever B was there.
             */
            a_near_b: number;
            /**
             * B Near A
             * @description As `a_near_b`.
             */
            b_near_a: number;
            /**
             * In Step
             * @description Of the way that both have, where they are so near at the same distance from their starts: how
             *     well they line up by distance. Null without a way.
             */
            in_step: number | null;
        };
        /**
         * RuleShare
         * @description A rule of the table the ride was ridden with: its cell is `rules[row][column]`.
         */
        RuleShare: {
            /**
             * Table
             * @enum {string}
             */
            table: "first" | "second";
            /** Row */
            row: number;
            /** Column */
            column: number;
            /**
             * Label
             * @enum {string}
             */
            label: "NB" | "NS" | "ZO" | "PS" | "PB";
            /** Speed Point Kmh */
            speed_point_kmh: number;
            /** Torque Rate Point */
            torque_rate_point: number;
            /** Seconds */
            seconds: number;
            /** Motor Wh */
            motor_wh: number;
            /**
             * Share
             * @description Of the ride's motor energy, 0 to 1.
             */
            share: number | null;
        };
        /** ScaleChange */
        ScaleChange: {
            /** Name */
            name: string;
            /** Old */
            old: unknown;
            /** New */
            new: unknown;
        };
        /**
         * Scenario
         * @description A ride that a simulated unit can be sent on: `scenario` of its simulation takes the name.
         */
        Scenario: {
            /** Name */
            name: string;
            /** Description */
            description: string;
        };
        /** ScenarioList */
        ScenarioList: {
            /** Items */
            items: components["schemas"]["Scenario"][];
            /** Next */
            next: string | null;
        };
        /**
         * SensorDrift
         * @description The zero of a unit's torque sensor over its rides, and when it will be too far.
         */
        SensorDrift: {
            /** Unit Key */
            unit_key: string;
            /** Method */
            method: number;
            /**
             * Watch Nm
             * @description More than the weather's share over 50 K.
             */
            watch_nm: number;
            /**
             * Act Nm
             * @description At rest the unit then reports TORQUE_DRIFT: no assist.
             */
            act_nm: number;
            /**
             * Level
             * @description Of the latest zero since the last calibration; null without one.
             */
            level: ("ok" | "watch" | "act") | null;
            latest: components["schemas"]["RideZero"] | null;
            /**
             * Rides
             * @description Newest first; also those without a zero.
             */
            rides: components["schemas"]["RideZero"][];
            /**
             * Calibrations
             * @description Oldest first.
             */
            calibrations: components["schemas"]["CalibrationMark"][];
            /** No Trend */
            no_trend: ("few_rides" | "short_time" | "none_since_calibration") | null;
            trend: components["schemas"]["DriftTrend"] | null;
        };
        /**
         * Series
         * @description Traces reduced to the plot's width; every extreme of the window is in them.
         *
         *     `rows`: each bin is one sample, so min and max are the same. `minmax`: the least and greatest
         *     of the samples from the bin's first time to its last.
         */
        Series: {
            /** From S */
            from_s: number;
            /** To S */
            to_s: number;
            /**
             * Rows
             * @description Samples in the bins.
             */
            rows: number;
            /** Bins */
            bins: number;
            /**
             * Kind
             * @enum {string}
             */
            kind: "rows" | "minmax";
            /**
             * Axis
             * @enum {string}
             */
            axis: "time" | "moving" | "distance";
            /** T First S */
            t_first_s: number[];
            /** T Last S */
            t_last_s: number[];
            /**
             * X First
             * @description As the times, in seconds in motion or metres; null for the axis `time`.
             */
            x_first: number[] | null;
            /** X Last */
            x_last: number[] | null;
            /** Channels */
            channels: components["schemas"]["SeriesChannel"][];
        };
        /**
         * SeriesChannel
         * @description Least and greatest value of each bin; a bin without a sample is null.
         */
        SeriesChannel: {
            /** Name */
            name: string;
            /** Unit */
            unit: string;
            /** Min */
            min: (number | null)[];
            /** Max */
            max: (number | null)[];
        };
        /** SeriesComparison */
        SeriesComparison: {
            /** Name */
            name: string;
            /** Unit */
            unit: string;
            /** @description Null where the ride has no such channel. */
            a: components["schemas"]["BinExtremes"] | null;
            b: components["schemas"]["BinExtremes"] | null;
            /**
             * Difference
             * @description Of the means over time of each bin, B less A, where both have one.
             */
            difference: (number | null)[] | null;
        };
        /**
         * Session
         * @description What a page needs to know before it shows anything.
         */
        Session: {
            /**
             * Sign In
             * @description Whether this server asks people to sign in.
             */
            sign_in: boolean;
            /**
             * Needs First
             * @description No administrator yet: the server printed a link.
             */
            needs_first: boolean;
            signed_in: components["schemas"]["SignedIn"] | null;
            /**
             * Passkeys
             * @description Whether people can sign in with a passkey at this address: it has https and a name.
             */
            passkeys: boolean;
        };
        /** SettingsDifference */
        SettingsDifference: {
            a: components["schemas"]["SideSettings"];
            b: components["schemas"]["SideSettings"];
            /**
             * Differences
             * @description From A to B by parameter; null unless both are known.
             */
            differences: components["schemas"]["ParameterChange"][] | null;
            /**
             * Tables
             * @description Those of which anything differs.
             */
            tables: components["schemas"]["TableDifference"][];
        };
        /**
         * Setup
         * @description Instruments and plan.
         *
         *     arm_m: from the spindle's axis to the pedal's. arm_again_m: the same, read once more before the
         *     fit counts: a wrong arm shows in no residual. arm_limit_m, level_limit_deg: half widths of
         *     what arm and crank angle may be. loads_kg: what is hung on in turn, without the zero. strokes:
         *     up and down again, of each side. angles_deg: 0 is the crank level and forward, positive the
         *     pedal going down. resolution_counts: the reading's step. gain_nm_per_count: what the unit was
         *     made with, which the slope is judged against. thermometer_limit_k: half width, of the sensor's
         *     own thermometer. *_limit_*_per_k: what a sensor drifts by at most if nobody measured it.
         */
        Setup: {
            /** Arm M */
            arm_m: number;
            /** Arm Limit M */
            arm_limit_m: number;
            gravity: components["schemas"]["Gravity"];
            /** Masses */
            masses: components["schemas"]["Mass"][];
            /** Loads Kg */
            loads_kg: number[];
            /** Full Scale Nm */
            full_scale_nm: number;
            /** Gain Nm Per Count */
            gain_nm_per_count: number;
            /**
             * Strokes
             * @default 2
             */
            strokes: number;
            /**
             * Sides
             * @default [
             *       "right",
             *       "left"
             *     ]
             */
            sides: ("left" | "right")[];
            /**
             * Angles Deg
             * @default [
             *       0
             *     ]
             */
            angles_deg: number[];
            /**
             * Level Limit Deg
             * @default 2
             */
            level_limit_deg: number;
            /**
             * Resolution Counts
             * @default 1
             */
            resolution_counts: number;
            /**
             * Thermometer Limit K
             * @default 0.5
             */
            thermometer_limit_k: number;
            /**
             * Zero Limit Nm Per K
             * @default 0.02
             */
            zero_limit_nm_per_k: number;
            /**
             * Span Limit Share Per K
             * @default 0.0002
             */
            span_limit_share_per_k: number;
            /** Arm Again M */
            arm_again_m?: number | null;
        };
        /**
         * SetupRequest
         * @description Instruments and plan. The gain that the unit was made with is the unit's to tell.
         */
        SetupRequest: {
            /**
             * Arm M
             * @description From the spindle's axis to the pedal's.
             */
            arm_m: number;
            /**
             * Arm Limit M
             * @description Half width of what it may be.
             */
            arm_limit_m: number;
            /** Gravity */
            gravity: components["schemas"]["GravityAt"] | components["schemas"]["GravityInput"];
            /** Masses */
            masses: components["schemas"]["MassRequest"][];
            /**
             * Loads Kg
             * @description What is hung on in turn, without the zero.
             */
            loads_kg: number[];
            /** Full Scale Nm */
            full_scale_nm: number;
            /**
             * Strokes
             * @default 2
             */
            strokes: number;
            /**
             * Sides
             * @default [
             *       "right",
             *       "left"
             *     ]
             */
            sides: ("left" | "right")[];
            /**
             * Angles Deg
             * @default [
             *       0
             *     ]
             */
            angles_deg: number[];
            /**
             * Level Limit Deg
             * @default 2
             */
            level_limit_deg: number;
            /**
             * Resolution Counts
             * @default 1
             */
            resolution_counts: number;
            /**
             * Thermometer Limit K
             * @default 0.5
             */
            thermometer_limit_k: number;
            /**
             * Zero Limit Nm Per K
             * @default 0.02
             */
            zero_limit_nm_per_k: number;
            /**
             * Span Limit Share Per K
             * @default 0.0002
             */
            span_limit_share_per_k: number;
            /**
             * Arm Again M
             * @description The same length, read once more before the fit.
             */
            arm_again_m?: number | null;
        };
        /**
         * Share
         * @description A coefficient: its value, standard uncertainty, and interval of 95 %.
         */
        Share: {
            /** Value */
            value: number;
            /** Uncertainty */
            uncertainty: number;
            /** Low */
            low: number;
            /** High */
            high: number;
        };
        /**
         * Side
         * @description What is compared: just one of `library`, `device` and `fuzzy_table`.
         */
        Side: {
            /**
             * Library
             * @description Id of an entry.
             */
            library?: string | null;
            /**
             * Version
             * @description Of an own item.
             */
            version?: number | null;
            /**
             * Device
             * @description What this unit has.
             */
            device?: string | null;
            /**
             * Revision
             * @description Of the device; what it has now if absent.
             */
            revision?: number | null;
            /** @description A draft. */
            fuzzy_table?: components["schemas"]["FuzzyTable"] | null;
            /**
             * Table
             * @description Of a configuration.
             * @default first
             * @enum {string}
             */
            table: "first" | "second";
        };
        /**
         * SideFigures
         * @description Of one pedal at the crank's first planned angle, percent of full scale.
         *
         *     linearity_load, linearity_line: against the loads and against their least-squares line.
         *     slope: of that line. total_*: root of the squares with repeatability by deviation and by range.
         */
        SideFigures: {
            /**
             * Side
             * @enum {string}
             */
            side: "left" | "right";
            /** Strokes */
            strokes: number;
            /** Linearity Load Pct */
            linearity_load_pct: number;
            /** Linearity Line Pct */
            linearity_line_pct: number;
            /** Hysteresis Pct */
            hysteresis_pct: number;
            /** Repeatability Deviation Pct */
            repeatability_deviation_pct: number;
            /** Repeatability Range Pct */
            repeatability_range_pct: number;
            /** Total Deviation Pct */
            total_deviation_pct: number;
            /** Total Range Pct */
            total_range_pct: number;
            /** Slope */
            slope: number;
        };
        /** SideSettings */
        SideSettings: {
            /** Is Known */
            is_known: boolean;
            /**
             * Why
             * @description Why the configuration is not known: a file brought the ride, its unit told none, or nobody kept what it told. Null where it is known.
             */
            why: ("imported" | "not_told" | "not_kept") | null;
            /** Unit Key */
            unit_key: string | null;
            /**
             * Generation
             * @description Null where the settings were changed before.
             */
            generation: number | null;
            /**
             * Changed At S
             * @description When they changed within the window: the rest of it was ridden by others.
             */
            changed_at_s: number[];
        };
        /** SignInRequest */
        SignInRequest: {
            /** Name */
            name: string;
            /**
             * Password
             * Format: password
             * @description At least 8 characters, none of the commonest; no other rule.
             */
            password: string;
        };
        /**
         * SignedIn
         * @description The signed-in user.
         */
        SignedIn: {
            person: components["schemas"]["Person"];
            /** Permissions */
            permissions: components["schemas"]["Permission"][];
        };
        /**
         * Simulation
         * @description What rider, road and clock of a simulated unit do now. A unit may tell more than this.
         */
        Simulation: {
            /** Scenario */
            scenario: string | null;
            /** Running */
            running: boolean;
            /** Speed Factor */
            speed_factor: number;
            /**
             * Clock
             * @enum {string}
             */
            clock: "real" | "virtual";
            /** Advance Left S */
            advance_left_s: number;
            /** T S */
            t_s: number;
            /** Seed */
            seed: number;
            rider: components["schemas"]["SimulationRider"];
            road: components["schemas"]["SimulationRoad"];
            /**
             * Load Source
             * @enum {string}
             */
            load_source: "road" | "dyno";
            /**
             * Dyno Nm
             * @description At the roller, on the bench only.
             */
            dyno_nm: number;
            /**
             * Dyno Convention
             * @enum {string}
             */
            dyno_convention: "physical" | "thesis";
            /**
             * Motor Model
             * @enum {string}
             */
            motor_model: "average" | "foc";
            /** Mass Kg */
            mass_kg: number;
            /** Assist Mode */
            assist_mode: number;
            /** Brake */
            brake: boolean;
            /** Walk Button */
            walk_button: boolean;
            /** Ambient Degc */
            ambient_degc: number;
            /** Grip */
            grip: number;
            /**
             * Faults
             * @description What is broken; empty: nothing.
             */
            faults: {
                [key: string]: boolean | number | string;
            };
            /** @description Null while the bike is on the road; nobody rides it here. */
            workbench?: components["schemas"]["SimulationWorkbench"] | null;
            rotor_link: components["schemas"]["SimulationRotorLink"];
            /**
             * Energy Balance Error Pct
             * @description By how much the energy books fail to close; null before any work was done.
             */
            energy_balance_error_pct: number | null;
            /** Energy Consistent */
            energy_consistent: boolean;
            /**
             * Label
             * @description `not energy consistent` where a printed equation makes energy, else null.
             */
            label: string | null;
        } & {
            [key: string]: unknown;
        };
        /**
         * SimulationAdvance
         * @description Time that shall pass for a unit with a virtual clock; a day at most.
         */
        SimulationAdvance: {
            /** Seconds */
            seconds: number;
        };
        /**
         * SimulationChange
         * @description Any subset; what is absent stays. A `scenario` starts from its beginning, null ends it.
         *
         *     The simulator itself refuses what it cannot simulate, and names it.
         */
        SimulationChange: {
            /** Scenario */
            scenario?: string | null;
            /** Running */
            running?: boolean | null;
            /** Speed Factor */
            speed_factor?: number | null;
            /** Clock */
            clock?: ("real" | "virtual") | null;
            /** Seed */
            seed?: number | null;
            rider?: components["schemas"]["SimulationRiderChange"] | null;
            road?: components["schemas"]["SimulationRoadChange"] | null;
            /** Load Source */
            load_source?: ("road" | "dyno") | null;
            /** Dyno Nm */
            dyno_nm?: number | null;
            /**
             * Dyno Convention
             * @description How its torque reaches the cranks: by energy, or as printed.
             */
            dyno_convention?: ("physical" | "thesis") | null;
            /**
             * Motor Model
             * @description Average, or phase currents under field-oriented control.
             */
            motor_model?: ("average" | "foc") | null;
            /** Mass Kg */
            mass_kg?: number | null;
            /** Assist Mode */
            assist_mode?: number | null;
            /** Brake */
            brake?: boolean | null;
            /** Walk Button */
            walk_button?: boolean | null;
            /** Ambient Degc */
            ambient_degc?: number | null;
            /**
             * Grip
             * @description Of the rear tyre; 0: it never slips.
             */
            grip?: number | null;
            faults?: components["schemas"]["SimulationFaults"] | null;
            /** @description What is hung on a pedal swings at first; null takes the bike off. */
            workbench?: components["schemas"]["SimulationWorkbenchChange"] | null;
        };
        /**
         * SimulationFaults
         * @description Simulated faults; they persist until cleared.
         */
        SimulationFaults: {
            /** Torque Sensor */
            torque_sensor?: ("sound" | "stuck" | "open_high" | "open_low" | "drifting") | null;
            /** Speed Sensor */
            speed_sensor?: ("sound" | "lost" | "stuck") | null;
            /** Link Lost */
            link_lost?: boolean | null;
            /** Motor Hall */
            motor_hall?: boolean | null;
            /** Battery Cut */
            battery_cut?: boolean | null;
            /** Motor Warmer K */
            motor_warmer_k?: number | null;
            /** Controller Warmer K */
            controller_warmer_k?: number | null;
            /** Pulses Missed */
            pulses_missed?: number | null;
            /** Bit Error Rate */
            bit_error_rate?: number | null;
            /** Burst Share */
            burst_share?: number | null;
            /** Coupling */
            coupling?: number | null;
        };
        /** SimulationRider */
        SimulationRider: {
            /**
             * Kind
             * @enum {string}
             */
            kind: "off" | "constant" | "legs";
            /** Torque Nm */
            torque_nm: number;
            /** Cadence Rpm Max */
            cadence_rpm_max: number;
        };
        /** SimulationRiderChange */
        SimulationRiderChange: {
            /** Kind */
            kind?: ("off" | "constant" | "legs") | null;
            /** Torque Nm */
            torque_nm?: number | null;
            /** Cadence Rpm Max */
            cadence_rpm_max?: number | null;
        };
        /** SimulationRoad */
        SimulationRoad: {
            /** Grade Deg */
            grade_deg: number;
            /** Wind Ms */
            wind_ms: number;
        };
        /** SimulationRoadChange */
        SimulationRoadChange: {
            /** Grade Deg */
            grade_deg?: number | null;
            /** Wind Ms */
            wind_ms?: number | null;
        };
        /**
         * SimulationRotorLink
         * @description Words of the link between spindle and housing, as the unit's receiver counted them.
         */
        SimulationRotorLink: {
            /** Words Good */
            words_good: number;
            /** Words Bad */
            words_bad: number;
            /** Words Lost */
            words_lost: number;
        };
        /**
         * SimulationWorkbench
         * @description A bike whose wheel is held, with a mass on a pedal. What hangs in truth is within the limits
         *     of what is said here.
         */
        SimulationWorkbench: {
            /**
             * Side
             * @enum {string}
             */
            side: "left" | "right";
            /** Mass Kg */
            mass_kg: number;
            /**
             * Crank Angle Deg
             * @description 0 is the crank level and forward, positive the pedal going down.
             */
            crank_angle_deg: number;
            /** Arm M */
            arm_m: number;
            /** Mass Limit Share */
            mass_limit_share: number;
            /** Arm Limit M */
            arm_limit_m: number;
            /** Angle Limit Deg */
            angle_limit_deg: number;
        };
        /** SimulationWorkbenchChange */
        SimulationWorkbenchChange: {
            /** Side */
            side?: ("left" | "right") | null;
            /** Mass Kg */
            mass_kg?: number | null;
            /** Crank Angle Deg */
            crank_angle_deg?: number | null;
            /** Arm M */
            arm_m?: number | null;
            /** Mass Limit Share */
            mass_limit_share?: number | null;
            /** Arm Limit M */
            arm_limit_m?: number | null;
            /** Angle Limit Deg */
            angle_limit_deg?: number | null;
        };
        /**
         * SinceChange
         * @description The rides since a change beside those before it.
         */
        SinceChange: {
            /** Seq */
            seq: number;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /**
             * Meaning
             * @description What it cannot tell, in English.
             */
            meaning: string;
            before: components["schemas"]["RidesTogether"];
            after: components["schemas"]["RidesTogether"];
            /**
             * Motor Wh Per Km After
             * @description `more`, `less`: every ride since took more, or less, than every ride before. `mixed`: they
             *     overlap. `too_few`: fewer than 3 on a side.
             * @enum {string}
             */
            motor_wh_per_km_after: "more" | "less" | "mixed" | "too_few";
            /**
             * During Ids
             * @description Rides on which the change was made: they are on neither side.
             */
            during_ids: number[];
            /**
             * Other Changes
             * @description How many other configurations the unit got between the first and the last of these rides:
             *     what moved may be theirs.
             */
            other_changes: number;
        };
        /**
         * SlopeRidden
         * @description A part of a ride, and how much higher its end lies than its begin.
         */
        SlopeRidden: {
            /** Ride Id */
            ride_id: number;
            /** From S */
            from_s?: number | null;
            /** To S */
            to_s?: number | null;
            /**
             * Rise M
             * @description Null: by the heights of the ride.
             */
            rise_m?: number | null;
        };
        /**
         * Snapshot
         * @description One row of every channel, in its unit; a channel without a value is null. t_us: unit time.
         */
        Snapshot: {
            /** T Us */
            t_us: number;
            /** Channels */
            channels: {
                [key: string]: number | null;
            };
        };
        /**
         * State
         * @description What was known while the counts were taken.
         *
         *     side, direction: None at zero where they make no difference. mass_kg: all that hangs on the
         *     pedal. arm_m: None is the setup's. sensor_degc: None where the unit does not tell it.
         */
        State: {
            /**
             * Kind
             * @enum {string}
             */
            kind: "zero" | "load" | "verify";
            /** Side */
            side?: ("left" | "right") | null;
            /**
             * Mass Kg
             * @default 0
             */
            mass_kg: number;
            /** Arm M */
            arm_m?: number | null;
            /**
             * Crank Angle Deg
             * @default 0
             */
            crank_angle_deg: number;
            /**
             * Stroke
             * @default 1
             */
            stroke: number;
            /** Direction */
            direction?: ("loading" | "unloading") | null;
            /** Sensor Degc */
            sensor_degc?: number | null;
        };
        /**
         * Step
         * @description One state to be captured.
         */
        Step: {
            state: components["schemas"]["State"];
            /**
             * Load Nm
             * @description What its mass makes.
             */
            load_nm: number;
            /**
             * Capture
             * @description The newest that counts; null: to be done.
             */
            capture: number | null;
        };
        /**
         * StorePlace
         * @description The database and the folder of rides and files, with what they hold.
         */
        StorePlace: {
            /**
             * Database
             * @description Its URL, without a password.
             */
            database: string;
            /**
             * Folder
             * @description Of rides and originals: a folder of the server's machine, or a bucket.
             */
            folder: string;
            /** Rides */
            rides: number;
            /**
             * Database Bytes
             * @description Null where a database server keeps it.
             */
            database_bytes: number | null;
            /** Object Bytes */
            object_bytes: number;
            /**
             * Free Bytes
             * @description On the disk of the folder; null for a bucket.
             */
            free_bytes: number | null;
        };
        /**
         * Struck
         * @description Why a capture does not count any more, by whom and since when.
         */
        Struck: {
            /** Reason */
            reason: string;
            /** Author */
            author: string;
            /**
             * At
             * Format: date-time
             */
            at: string;
        };
        /**
         * SupportFile
         * @description A unit as it says it is; null is what it could not say now.
         */
        SupportFile: {
            /** Format */
            format: string;
            /** Version */
            version: number;
            /** Spindle Version */
            spindle_version: string;
            /**
             * Made At
             * Format: date-time
             */
            made_at: string;
            /** Left Out */
            left_out: string[];
            /** Family */
            family: string;
            /**
             * State
             * @enum {string}
             */
            state: "connecting" | "ready" | "read_only" | "lost" | "closed";
            /** Reason Code */
            reason_code: string;
            /** Capabilities */
            capabilities: components["schemas"]["Capability"][];
            identity: components["schemas"]["Identity"] | null;
            config: components["schemas"]["ConfigStamp"] | null;
            /** Link */
            link: {
                [key: string]: number | null;
            };
            /** Faults */
            faults: components["schemas"]["Fault"][];
            checks: components["schemas"]["UnitChecks"] | null;
            /**
             * Parameters
             * @description By name, as last read.
             */
            parameters: {
                [key: string]: unknown;
            } | null;
            /**
             * Revisions
             * @description Newest first.
             */
            revisions: components["schemas"]["SupportRevision"][];
        };
        /**
         * SupportRevision
         * @description A configuration that the unit had, without who gave it and why.
         */
        SupportRevision: {
            /** Seq */
            seq: number;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /** State */
            state: string;
            /** Generation */
            generation: number | null;
            /** Crc32 */
            crc32: number | null;
            /** Changed */
            changed: {
                [key: string]: unknown;
            }[];
        };
        /** Surface */
        Surface: {
            /**
             * Gain
             * @description `gain[speed][torque rate]`
             */
            gain: number[][];
            /**
             * Engine
             * @description Which code computed it: the unit's own.
             */
            engine: string;
        };
        /** SurfaceRequest */
        SurfaceRequest: {
            fuzzy_table: components["schemas"]["FuzzyTable"];
            /** Speeds Kmh */
            speeds_kmh: number[];
            /** Torque Rates */
            torque_rates: number[];
        };
        /**
         * TableAnswer
         * @description What was said before.
         */
        TableAnswer: {
            /**
             * Time Zone
             * @description A name of the IANA database.
             */
            time_zone: string | null;
            /**
             * Units
             * @description By column.
             */
            units: {
                [key: string]: string;
            };
            /**
             * Rows Per Second
             * @description Of rows without a time.
             */
            rows_per_second: number | null;
            /**
             * Date Order
             * @description How 03/04 is read: 3 April or 4 March.
             */
            date_order: ("day_first" | "month_first") | null;
            /**
             * Channels
             * @description By column, what it is; `""` for none of ours.
             */
            channels: {
                [key: string]: string;
            };
        };
        /**
         * TableAnswerRequest
         * @description What an owner says of a table. It is kept for every file with the same header.
         */
        TableAnswerRequest: {
            /**
             * Time Zone
             * @description An IANA name: `Europe/Dublin`, `UTC`.
             */
            time_zone?: string | null;
            /**
             * Units
             * @description By the column's name.
             */
            units?: {
                [key: string]: string;
            };
            /** Rows Per Second */
            rows_per_second?: number | null;
            /**
             * Date Order
             * @description How 03/04 is read: 3 April or 4 March.
             */
            date_order?: ("day_first" | "month_first") | null;
            /**
             * Channels
             * @description What a column is, by its name, whether that is asked or not: a name of `offered_channels`; `""` for none of them, its numbers stay under its own name.
             */
            channels?: {
                [key: string]: string;
            };
            /**
             * Read Again
             * @description Whether other files with this header that were read before are read by it.
             * @default false
             */
            read_again: boolean;
        };
        /**
         * TableColumn
         * @description One column of a table.
         */
        TableColumn: {
            /** Name */
            name: string;
            /**
             * Channel
             * @description What it becomes, or `time`; null for nothing known.
             */
            channel: string | null;
            /**
             * Unit
             * @description As the table says it; null where it must be said.
             */
            unit: string | null;
            /**
             * Units
             * @description What may be said; empty where nothing is asked.
             * @default []
             */
            units: string[];
            /**
             * Samples
             * @description Of the first rows; of a column that cannot be read, of what stands there.
             * @default []
             */
            samples: string[];
            /**
             * Channels
             * @description What it may be where that must be stated, `""` to leave it out; empty: nothing is asked.
             * @default []
             */
            channels: string[];
            /**
             * Unread
             * @description Cells that hold something that is no number.
             * @default 0
             */
            unread: number;
        };
        /**
         * TableComparison
         * @description Two tables, point by point and by what the unit computes of them.
         */
        TableComparison: {
            /** Cells */
            cells: components["schemas"]["CellChange"][];
            /**
             * Points Changed
             * @description Which of the three rows of points differ.
             */
            points_changed: ("speed_points_kmh" | "torque_rate_points" | "gain_points")[];
            /** Inference Changed */
            inference_changed: boolean;
            /** Speeds Kmh */
            speeds_kmh: number[];
            /** Torque Rates */
            torque_rates: number[];
            /**
             * Left
             * @description Gain, `[speed][torque rate]`.
             */
            left: number[][];
            /**
             * Right
             * @description As `left`.
             */
            right: number[][];
            /** @description Looked for over a finer grid and at every point of both. */
            largest: components["schemas"]["LargestDifference"];
        };
        /** TableDifference */
        TableDifference: {
            /**
             * Which
             * @enum {string}
             */
            which: "first" | "second";
            left: components["schemas"]["FuzzyTable"];
            right: components["schemas"]["FuzzyTable"];
            /** Cells */
            cells: components["schemas"]["CellChange"][];
        };
        /**
         * TableQuestion
         * @description What can be said of a table, and what must be before it is read.
         */
        TableQuestion: {
            /** Header Sha256 */
            header_sha256: string;
            /** Kind */
            kind: string;
            /**
             * Time Zone
             * @description Its times have no zone.
             */
            time_zone: boolean;
            /**
             * Rows Per Second
             * @description Its rows have no time.
             */
            rows_per_second: boolean;
            /**
             * Date Order
             * @description Whether 03/04 is in April or in March.
             */
            date_order: boolean;
            /** Columns */
            columns: components["schemas"]["TableColumn"][];
            /** Offered Channels */
            offered_channels: components["schemas"]["OfferedChannel"][];
            answer: components["schemas"]["TableAnswer"] | null;
            /**
             * Files Read
             * @description Other files with this header whose rides are here.
             */
            files_read: number;
        };
        /** TableReview */
        TableReview: {
            /** Name */
            name: string;
            /**
             * Kind
             * @enum {string}
             */
            kind: "table" | "configuration";
            /** @description Null for a partial configuration that has none. */
            fuzzy_table: components["schemas"]["FuzzyTable"] | null;
            feel: components["schemas"]["Feel"] | null;
            /**
             * No Feel Reason
             * @description Why nothing could be measured.
             */
            no_feel_reason: string | null;
        };
        /**
         * TableUse
         * @description Where in the table the rides were: time and motor energy of each cell.
         *
         *     Counted are the moments in which the rider pedalled and the table said what the motor was asked
         *     for. Each belongs to the at most four cells whose rules fired, in the shares of the law's sets,
         *     so the cells' seconds add up to `assisted_s`. A recorded torque rate never exceeds the last
         *     point of the table ridden with. `motor_wh` is work at the motor's shaft, null where no ride has
         *     a torque that the motor delivered.
         */
        TableUse: {
            /**
             * Table
             * @enum {string}
             */
            table: "first" | "second";
            /**
             * Rides
             * @description Ids of the rides counted, newest first.
             */
            rides: number[];
            /** Rides Without */
            rides_without: components["schemas"]["RideWithout"][];
            /**
             * Rides By Defaults
             * @description Of the rides counted those whose configuration nobody kept; the law's defaults say which of their modes ran by the table.
             */
            rides_by_defaults: number[];
            /**
             * More
             * @description There are older rides, which were not looked at.
             */
            more: boolean;
            /**
             * Since
             * @description Start of the oldest ride counted.
             */
            since: string | null;
            /** Assisted S */
            assisted_s: number;
            /**
             * Motor Excluded S
             * @description Part of `assisted_s` whose motor power is not known: not in `motor_wh`.
             */
            motor_excluded_s: number;
            /**
             * Torque Rate Points Proposed
             * @description Points that these rides use evenly, from 0 on: they divide the time in which the torque rose by 25, 50, 75 and 98 %. Null where it rose for less than a minute.
             */
            torque_rate_points_proposed: number[] | null;
            /** Columns */
            columns: components["schemas"]["UseOfPoint"][];
            /** Rows */
            rows: components["schemas"]["UseOfPoint"][];
            cells: components["schemas"]["UseOfCells"];
        };
        /**
         * TableUseRequest
         * @description Which rides, and the table as it is edited: its points may differ from those ridden with.
         */
        TableUseRequest: {
            /**
             * Ride Ids
             * @description Without it the latest 20 rides that are over.
             */
            ride_ids?: number[] | null;
            /**
             * Device
             * @description Whose latest rides: a unit's key or serial number, or a device's id. Without it every unit's. Not together with `ride_ids`.
             */
            device?: string | null;
            /**
             * Table
             * @description Counted is what modes gave that ran by this one then.
             * @default first
             * @enum {string}
             */
            table: "first" | "second";
            /** Speed Points Kmh */
            speed_points_kmh: number[];
            /** Torque Rate Points */
            torque_rate_points: number[];
        };
        /** TagInUse */
        TagInUse: {
            /** Tag */
            tag: string;
            /** Rides */
            rides: number;
        };
        /** Ticket */
        Ticket: {
            /**
             * Ticket
             * @description For `?ticket=` of one WebSocket, soon.
             */
            ticket: string;
            /** Valid S */
            valid_s: number;
        };
        /**
         * TimeAtLimit
         * @description Seconds on the way that a limit of the registry was at work; an estimate without a band.
         */
        TimeAtLimit: {
            /** Limit */
            limit: string;
            /**
             * Recorded S
             * @description Null where the ride does not tell its limits.
             */
            recorded_s: number | null;
            /** Replayed S */
            replayed_s: number;
        };
        /**
         * TorqueSurface
         * @description At the crank, rows = speeds. What is given for long: ramps are over, the mean of a minute
         *     that a continuous rating is held against has come to rest, the battery has its nominal voltage
         *     and the motor is cool.
         */
        TorqueSurface: {
            /** Speeds Kmh */
            speeds_kmh: number[];
            /** Torque Rates */
            torque_rates: number[];
            /**
             * Demanded Nm
             * @description By the mode's law.
             */
            demanded_nm: number[][];
            /**
             * Delivered Nm
             * @description What is left of it after every limit.
             */
            delivered_nm: number[][];
            /**
             * Limit Flags
             * @description Bits of the registry: what held it back.
             */
            limit_flags: number[][];
            /** Cadence Rpm */
            cadence_rpm: number;
            /**
             * Crank Rad Per S
             * @description Torque times this is the power.
             */
            crank_rad_per_s: number;
            /** Engine */
            engine: string;
        };
        /**
         * TorqueSurfaceRequest
         * @description A configuration as it is edited; what is left out has the law's defaults.
         */
        TorqueSurfaceRequest: {
            /** Parameters */
            parameters: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
            /**
             * Mode
             * @description The slot whose table and ratio are asked.
             */
            mode: number;
            /**
             * Rider Torque Nm
             * @default 30
             */
            rider_torque_nm: number;
            /**
             * Speeds Kmh
             * @description Increasing.
             */
            speeds_kmh: number[];
            /**
             * Torque Rates
             * @description Increasing.
             */
            torque_rates: number[];
        };
        /**
         * Track
         * @description Points of a ride in order of time; an array is null where the ride never tells it, and a
         *     position is null in a gap. Half of the points stand evenly in time, the others where the track
         *     bends most.
         */
        Track: {
            /** T S */
            t_s: number[];
            /**
             * Moving S
             * @description Seconds in motion since the start.
             */
            moving_s: number[] | null;
            /**
             * Distance M
             * @description Way since the start.
             */
            distance_m: number[] | null;
            /** Latitude Deg */
            latitude_deg: (number | null)[] | null;
            /** Longitude Deg */
            longitude_deg: (number | null)[] | null;
        };
        /**
         * TrialValues
         * @description What is on trial over the configuration, in the unit's memory alone; null where nothing is.
         *
         *     parameters: those that differ from the configuration, with the value in force.
         */
        TrialValues: {
            /** Parameters */
            parameters: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
            /** Remaining S */
            remaining_s: number | null;
            /** Expires At */
            expires_at: string | null;
        };
        /**
         * TrialValuesRequest
         * @description Values to put on trial at once, in the unit's memory alone.
         */
        TrialValuesRequest: {
            /** Parameters */
            parameters: {
                [key: string]: number | string | (number | string)[] | (number | string)[][] | null;
            };
            /**
             * Ttl S
             * @description The unit ends it after so many seconds.
             */
            ttl_s: number;
        };
        /**
         * Trust
         * @description How far the twin is off without any change, and what it rests on.
         */
        Trust: {
            /**
             * No Change Error Pct
             * @description Of the motor's work.
             */
            no_change_error_pct: number;
            /** No Change Time Error Pct */
            no_change_time_error_pct: number;
            /**
             * Mass Kg
             * @description As told, or as assumed.
             */
            mass_kg: number;
            /**
             * Drag Area M2
             * @description As told, or as assumed.
             */
            drag_area_m2: number;
            /**
             * One Gear
             * @description False where the rider shifted: then he shifts again so that the cranks turn as they did there, and the band is wider by those who shift less.
             */
            one_gear: boolean;
        };
        /**
         * TwoDefinitions
         * @description By deviation from the mean, and by the range of the readings (thesis_checks I-26).
         */
        TwoDefinitions: {
            /** Deviation */
            deviation: number;
            /** Range */
            range: number;
        };
        /**
         * UnitCheck
         * @description One check. Numbers are in `unit`; what is null is not known or does not apply.
         */
        UnitCheck: {
            /**
             * Name
             * @enum {string}
             */
            name: "zero" | "drift" | "rotor" | "battery" | "motor" | "controller" | "flash" | "line";
            /**
             * Passed
             * @description Null: not done; `not_done` says why.
             */
            passed: boolean | null;
            /** Value */
            value: number | null;
            /** Unit */
            unit: string | null;
            /**
             * Limit
             * @description It passes up to here; a battery's voltage from here on.
             */
            limit: number | null;
            /** Not Done */
            not_done: ("no_reading" | "not_sent" | "moving" | "no_ride_shows_it" | "not_known") | null;
            /**
             * Fault
             * @description What the unit itself calls faulty: then it has failed, whatever it reads.
             */
            fault: string | null;
            /**
             * Evidence
             * @description What else was seen: of `drift` the ride, how many show the zero, the trend a month and the
             *     level; of `flash` its erases and places; of `line` frames built and lost.
             */
            evidence: {
                [key: string]: unknown;
            } | null;
        };
        /**
         * UnitChecks
         * @description What was found, and the readings it was found by.
         */
        UnitChecks: {
            /**
             * Checked At
             * Format: date-time
             */
            checked_at: string;
            /** Checks */
            checks: components["schemas"]["UnitCheck"][];
            /** Channels */
            channels: {
                [key: string]: number | null;
            };
            /** Faults Active */
            faults_active: string[];
            /** @description Null for a unit of another make, which does not count. */
            wear: components["schemas"]["WearCounters"] | null;
        };
        /** UnitComparison */
        UnitComparison: {
            /** Device Id */
            device_id: string;
            /**
             * Stored M
             * @description What the unit counts with.
             */
            stored_m: number;
            /**
             * Free Min M
             * @description What may be set without the maker's token.
             */
            free_min_m: number | null;
            /** Free Max M */
            free_max_m: number | null;
            /**
             * In Band
             * @description The measured value lies there; null: no band.
             */
            in_band: boolean | null;
            /**
             * Difference Pct
             * @description Of the measured value from the stored one.
             */
            difference_pct: number;
            /**
             * Agrees
             * @description They differ by no more than the expanded uncertainty.
             */
            agrees: boolean;
            /** @description At what true speed the unit's assist cut-off lies; null: it has none. */
            cut_off: components["schemas"]["CutOff"] | null;
        };
        /**
         * UnitLimits
         * @description What the unit enforces after the law, whatever the table says.
         *
         *     The last three may be missing in what is written; only the maker changes the market.
         */
        UnitLimits: {
            /** Assist Cutoff Kmh */
            assist_cutoff_kmh: number;
            /** Assist Cutoff Band Kmh */
            assist_cutoff_band_kmh: number;
            /** Motor Torque Nm Max */
            motor_torque_nm_max: number;
            /** Battery Current A Max */
            battery_current_a_max: number;
            /** Battery Voltage V Min */
            battery_voltage_v_min: number;
            /** Motor Speed Rpm Max */
            motor_speed_rpm_max: number;
            /** Pedal Stop Ms */
            pedal_stop_ms: number;
            /**
             * Market
             * @description Whose law has the last word.
             */
            market?: ("eu_epac" | "uk" | "us_class_1" | "us_class_2" | "us_class_3" | "japan" | "china") | null;
            /** Assist Cutoff Extra Kmh */
            assist_cutoff_extra_kmh?: number | null;
            /**
             * Effective Assist Cutoff Kmh
             * @description Where assist ends: `assist_cutoff_kmh`, or less where the market allows less. Told by the unit's own code; not looked at when it is written. Null while the unit has lost settings, which its faults tell.
             */
            readonly effective_assist_cutoff_kmh?: number | null;
        };
        /** UnitLog */
        UnitLog: {
            /** Log Id */
            log_id: number;
            /**
             * Generation
             * @description Tells a log from another of the same number.
             */
            generation: number;
            /**
             * State
             * @enum {string}
             */
            state: "recording" | "closed" | "cut_off";
            /**
             * Started At
             * @description Null when the unit was restarted since.
             */
            started_at: string | null;
            /** Duration S */
            duration_s: number;
            /** Length */
            length: number;
            /** Confirmed */
            confirmed: boolean;
            download: components["schemas"]["LogDownload"] | null;
        };
        /**
         * UnitLogs
         * @description The oldest first. overwritten: given up by the unit before anybody fetched them.
         */
        UnitLogs: {
            /** Items */
            items: components["schemas"]["UnitLog"][];
            /** Overwritten */
            overwritten: number;
            /** Next */
            next: string | null;
        };
        /**
         * Upload
         * @description Where a file stands. `code` and `detail` say why it is not a whole ride.
         *
         *     A file that rides came from lives as long as one of them; any other can be removed.
         */
        Upload: {
            /** Id */
            id: string;
            /** Name */
            name: string;
            /** Length */
            length: number;
            /** Received */
            received: number;
            /**
             * State
             * @enum {string}
             */
            state: "receiving" | "queued" | "complete" | "partial" | "rejected";
            /** Code */
            code: string | null;
            /** Detail */
            detail: string | null;
            /** Ride Ids */
            ride_ids: number[];
            /** Completeness */
            completeness: number | null;
            /**
             * Duplicate Of
             * @description The ride the same bytes became before.
             */
            duplicate_of: number | null;
            /**
             * Expires At
             * @description When it goes by itself; null while a ride lives on it or it waits to be read.
             */
            expires_at: string | null;
            /**
             * Part Of
             * @description The upload of the container it came within.
             */
            part_of: string | null;
            /** @description Of a container; null for any other file. */
            parts: components["schemas"]["UploadParts"] | null;
            /**
             * Has Columns
             * @description Whether its owner can say what it leaves open: `get_mapping`.
             */
            has_columns: boolean;
            /**
             * Doubtful Rides
             * @description How many of its rides have figures that disagree or cannot be.
             */
            doubtful_rides: number;
        };
        /** UploadList */
        UploadList: {
            /** Items */
            items: components["schemas"]["Upload"][];
            /** Next */
            next: string | null;
        };
        /**
         * UploadParts
         * @description How many of the files within a container are in which state.
         */
        UploadParts: {
            /**
             * Waiting
             * @default 0
             */
            waiting: number;
            /**
             * Complete
             * @default 0
             */
            complete: number;
            /**
             * Partial
             * @default 0
             */
            partial: number;
            /**
             * Rejected
             * @default 0
             */
            rejected: number;
            /**
             * Here
             * @description Rides that were known before the container came.
             * @default 0
             */
            here: number;
        };
        /**
         * UseOfCells
         * @description `[speed][torque rate]`, as the rules.
         */
        UseOfCells: {
            /** Seconds */
            seconds: number[][];
            /** Motor Wh */
            motor_wh: number[][] | null;
        };
        /**
         * UseOfPoint
         * @description A row or column of the table: its cells together.
         */
        UseOfPoint: {
            /**
             * Point
             * @description Speed in km/h of a row, torque rate of a column.
             */
            point: number;
            /** Seconds */
            seconds: number;
            /**
             * Share
             * @description Of `assisted_s`, 0 to 1; null where that is 0.
             */
            share: number | null;
            /** Motor Wh */
            motor_wh: number | null;
        };
        /**
         * Verification
         * @description One verifying capture. expanded_nm: of the difference, k = 2, without what arm, masses and
         *     gravity leave open: both used the same. en: the difference in those; 1 or less agrees
         *     (ISO/IEC 17043, B.3). unseen: no capture of the fit had this mass.
         */
        Verification: {
            /** Capture */
            capture: number;
            /** Load Nm */
            load_nm: number;
            /** Reading Nm */
            reading_nm: number;
            /** Difference Nm */
            difference_nm: number;
            /** Expanded Nm */
            expanded_nm: number;
            /** En */
            en: number;
            /** Unseen */
            unseen: boolean;
        };
        /**
         * VerifyRequest
         * @description A mass that the fit has not seen.
         */
        VerifyRequest: {
            /**
             * Side
             * @enum {string}
             */
            side: "left" | "right";
            /** Mass Kg */
            mass_kg: number;
            /**
             * Arm M
             * @description The setup's if null.
             */
            arm_m?: number | null;
            /**
             * Crank Angle Deg
             * @description 0: the crank level and forward; positive: pedal going down.
             * @default 0
             */
            crank_angle_deg: number;
        };
        /**
         * Visit
         * @description A service visit of a bike.
         */
        Visit: {
            /** Id */
            id: number;
            /**
             * Token
             * @description The same on every server that has this visit.
             */
            token: string;
            /** Bike Id */
            bike_id: number;
            /** Bike Name */
            bike_name: string;
            /**
             * State
             * @enum {string}
             */
            state: "open" | "closed";
            /**
             * Opened At
             * Format: date-time
             */
            opened_at: string;
            /** Opened By */
            opened_by: string;
            /** Closed At */
            closed_at: string | null;
            /**
             * Version
             * @description Counts the changes of what people wrote.
             */
            version: number;
            /**
             * Imported
             * @description It came with a bike's history from another server.
             */
            imported: boolean;
            content: components["schemas"]["VisitContent"];
            /**
             * Content Sha256
             * @description Of the content; what the owner consents to.
             */
            content_sha256: string;
            consent: components["schemas"]["VisitConsent"] | null;
            /**
             * Consent Holds
             * @description Nothing is otherwise than what was consented to.
             */
            consent_holds: boolean;
        };
        /**
         * VisitCalibration
         * @description A calibration that was closed during the visit; what it came to is null without a fit.
         */
        VisitCalibration: {
            /** Id */
            id: number;
            /**
             * Closed At
             * Format: date-time
             */
            closed_at: string;
            /** Author */
            author: string;
            /**
             * Sha256
             * @description Of its file.
             */
            sha256: string;
            /** Verdict */
            verdict: ("pass" | "conditional" | "fail") | null;
            /** Linearity Pct */
            linearity_pct: number | null;
            /** Hysteresis Pct */
            hysteresis_pct: number | null;
            /**
             * Expanded Nm
             * @description The largest uncertainty of the torque, k = 2.
             */
            expanded_nm: number | null;
        };
        /**
         * VisitChange
         * @description A setting that is otherwise than before the visit, whatever was tried in between.
         */
        VisitChange: {
            /** Parameter */
            parameter: string;
            /** Old */
            old: unknown;
            /** New */
            new: unknown;
            /**
             * Changed At
             * Format: date-time
             */
            changed_at: string;
            /** Author */
            author: string;
            /** Reason */
            reason: string;
        };
        /** VisitChangeIn */
        VisitChangeIn: {
            /**
             * Job
             * @default
             */
            job: string;
            /**
             * Technician
             * @default
             */
            technician: string;
            /**
             * Customer
             * @default
             */
            customer: string;
            /** Counter Km */
            counter_km?: number | null;
            /**
             * Complaint
             * @default
             */
            complaint: string;
            /**
             * Done
             * @default
             */
            done: string;
            /**
             * Notes
             * @default
             */
            notes: string;
            /** Parts */
            parts?: components["schemas"]["VisitPartIn"][];
            /**
             * Version
             * @description The version that was changed; 409 if it is another.
             */
            version: number;
        };
        /**
         * VisitConsent
         * @description The owner's consent to what was done, as the visit's content was then.
         */
        VisitConsent: {
            /**
             * By
             * @enum {string}
             */
            by: "account" | "signature";
            /**
             * Name
             * @description Null for an earlier owner's, to an owner.
             */
            name: string | null;
            /**
             * Person Id
             * @description The account's number; null for a signature, and for an earlier owner's, to an owner.
             */
            person_id: number | null;
            /**
             * At
             * Format: date-time
             */
            at: string;
            /** Content Sha256 */
            content_sha256: string;
            /**
             * Strokes
             * @description Of a signature: each x, y, x, y, ... as shares of the field's width and height.
             */
            strokes: number[][];
        };
        /**
         * VisitConsentIn
         * @description An owner with an account says nothing more; a workshop hands over the name and the signature
         *     that somebody drew.
         */
        VisitConsentIn: {
            /**
             * Content Sha256
             * @description What is consented to; 409 if it is otherwise now.
             */
            content_sha256: string;
            /**
             * Name
             * @default
             */
            name: string;
            /** Strokes */
            strokes?: number[][];
        };
        /**
         * VisitContent
         * @description What a visit is about. The workshop writes the words, the server adds what units report.
         */
        VisitContent: {
            /**
             * Job
             * @description The workshop's number of the job.
             * @default
             */
            job: string;
            /**
             * Technician
             * @default
             */
            technician: string;
            /**
             * Customer
             * @description Who brought it. Not in the history that goes on to others, and for the workshop only.
             * @default
             */
            customer: string;
            /** Counter Km */
            counter_km: number | null;
            /**
             * Complaint
             * @default
             */
            complaint: string;
            /**
             * Done
             * @default
             */
            done: string;
            /**
             * Notes
             * @default
             */
            notes: string;
            /**
             * Parts
             * @default []
             */
            parts: components["schemas"]["VisitPart"][];
            /**
             * Unit Key
             * @description The unit that was on the bike when the visit began.
             */
            unit_key: string | null;
            /**
             * Revision Seq
             * @description The newest configuration of that unit when the visit began.
             */
            revision_seq: number | null;
            /** @description The first readings. */
            before: components["schemas"]["VisitReadings"] | null;
            /** @description The last ones, null before there are second ones. */
            after: components["schemas"]["VisitReadings"] | null;
            /**
             * Faults
             * @default []
             */
            faults: components["schemas"]["VisitFault"][];
            /**
             * Changes
             * @default []
             */
            changes: components["schemas"]["VisitChange"][];
            /**
             * Calibrations
             * @default []
             */
            calibrations: components["schemas"]["VisitCalibration"][];
            /**
             * Photos
             * @default []
             */
            photos: components["schemas"]["VisitPhoto"][];
        };
        /**
         * VisitFault
         * @description A fault that the unit had during the visit, or remembered.
         */
        VisitFault: {
            /** Name */
            name: string;
            /**
             * Count
             * @description How often since the unit's start, as last seen.
             */
            count: number | null;
            /**
             * Seen At
             * Format: date-time
             */
            seen_at: string;
            /**
             * Over At
             * @description When it was first seen to be over, null while it is there.
             */
            over_at: string | null;
        };
        /** VisitIn */
        VisitIn: {
            /**
             * Job
             * @default
             */
            job: string;
            /**
             * Technician
             * @default
             */
            technician: string;
            /**
             * Customer
             * @default
             */
            customer: string;
            /** Counter Km */
            counter_km?: number | null;
            /**
             * Complaint
             * @default
             */
            complaint: string;
            /**
             * Done
             * @default
             */
            done: string;
            /**
             * Notes
             * @default
             */
            notes: string;
            /** Parts */
            parts?: components["schemas"]["VisitPartIn"][];
            /**
             * Device Id
             * @description The unit on the bike, to be looked at now.
             */
            device_id?: string | null;
        };
        /**
         * VisitList
         * @description The newest first.
         */
        VisitList: {
            /** Items */
            items: components["schemas"]["Visit"][];
        };
        /**
         * VisitPart
         * @description What was built in.
         */
        VisitPart: {
            /** Name */
            name: string;
            /**
             * Number
             * @description The maker's number of it.
             */
            number: string | null;
            /** Quantity */
            quantity: number;
        };
        /** VisitPartIn */
        VisitPartIn: {
            /** Name */
            name: string;
            /** Number */
            number?: string | null;
            /**
             * Quantity
             * @default 1
             */
            quantity: number;
        };
        /**
         * VisitPhoto
         * @description A photograph, without what the camera wrote into it.
         */
        VisitPhoto: {
            /** Sha256 */
            sha256: string;
            /** Name */
            name: string;
            /** Width Px */
            width_px: number;
            /** Height Px */
            height_px: number;
            /** Size Bytes */
            size_bytes: number;
            /**
             * Added At
             * Format: date-time
             */
            added_at: string;
        };
        /**
         * VisitReadings
         * @description The unit as it was looked at.
         */
        VisitReadings: {
            /**
             * At
             * Format: date-time
             */
            at: string;
            /** Unit Key */
            unit_key: string;
            /** Serial Number */
            serial_number: string | null;
            /** Model */
            model: string | null;
            /** Firmware Version */
            firmware_version: string | null;
            /** Generation */
            generation: number | null;
            /** Crc32 */
            crc32: number | null;
            /** Checks */
            checks: components["schemas"]["UnitCheck"][];
            /** Faults Active */
            faults_active: string[];
        };
        /** VisitReadingsIn */
        VisitReadingsIn: {
            /**
             * Device Id
             * @description The unit on the bike.
             */
            device_id: string;
        };
        /**
         * WearCounters
         * @description What the unit knows of its own wear. What is not saved yet is lost with its supply, a minute
         *     at most.
         */
        WearCounters: {
            /** Distance M */
            distance_m: number;
            /** Operating S */
            operating_s: number;
            /** Saved Distance M */
            saved_distance_m: number;
            /** Saved Operating S */
            saved_operating_s: number;
            /** Config Slots */
            config_slots: components["schemas"]["ConfigSlot"][];
            /**
             * Runs On Default
             * @description Neither slot is good: the factory's values apply.
             */
            runs_on_default: boolean;
        };
        /** Wheel */
        Wheel: {
            measured: components["schemas"]["Circumference"];
            /**
             * Distance M
             * @description On the ground; of rolls, their mean.
             */
            distance_m: number;
            /**
             * Turns
             * @description Of the wheel, on that distance.
             */
            turns: number;
            /**
             * Noise M
             * @description Of a position, in each direction; null: rolled.
             */
            noise_m: number | null;
            unit_comparison: components["schemas"]["UnitComparison"] | null;
        };
        /**
         * WheelByTrack
         * @description A ride whose speed is counted by the wheel, and positions of the same way.
         */
        WheelByTrack: {
            /** Ride Id */
            ride_id: number;
            /** From S */
            from_s?: number | null;
            /** To S */
            to_s?: number | null;
            /**
             * Track Ride Id
             * @description Another device's ride at the same time, which has the positions; the bike stands at both ends of the window then. Null: the ride itself has them.
             */
            track_ride_id?: number | null;
            /**
             * Device Circumference M
             * @description What the ride's device counts with; null: as its stored configuration says.
             */
            device_circumference_m?: number | null;
            /**
             * Device Id
             * @description A connected unit to compare with; null: none.
             */
            device_id?: string | null;
        };
        /**
         * Why
         * @description A control step in the unit's own order. Torques are at the crank, missing is null.
         *
         *     The torques of `steps` add up to `delivered_nm`, by a last step `current_control`: what the
         *     motor gave less what it was told. Where nothing was measured there is no such step, and they
         *     add up to `commanded_nm`. Where the input was refused the one step says so.
         */
        Why: {
            moment: components["schemas"]["WhyMoment"];
            /**
             * Config Source
             * @enum {string}
             */
            config_source: "ride" | "unit" | "given";
            /** Engine */
            engine: string;
            /**
             * Warmed Up S
             * @description Of the ride before the moment, from which the law remembers.
             */
            warmed_up_s: number | null;
            /**
             * Result
             * @enum {string}
             */
            result: "ok" | "input_refused" | "result_lost";
            /**
             * Law
             * @enum {string}
             */
            law: "off" | "fixed" | "fuzzy" | "walk";
            /** Mode */
            mode: number;
            /** Mode Name */
            mode_name: string;
            /** @description The mode's; null where its law has none. */
            table: components["schemas"]["FuzzyTable"] | null;
            /** Speed Kmh */
            speed_kmh: number | null;
            /** Cadence Rpm */
            cadence_rpm: number | null;
            /**
             * Rider Torque Nm
             * @description As the law averages it over the stroke.
             */
            rider_torque_nm: number | null;
            /** Torque Rate */
            torque_rate: number | null;
            /** Rules */
            rules: components["schemas"]["FiredRule"][];
            /**
             * Gain
             * @description Null where the mode has none.
             */
            gain: number | null;
            /** Assist Ratio */
            assist_ratio: number | null;
            /** Crank Rad Per S */
            crank_rad_per_s: number | null;
            /** Steps */
            steps: components["schemas"]["WhyStep"][];
            /** Commanded Nm */
            commanded_nm: number;
            /**
             * Available Nm
             * @description What motor, heat, battery and back-EMF allow; null for a refused input.
             */
            available_nm: number | null;
            /** Delivered Nm */
            delivered_nm: number | null;
            /** Limit Flags */
            limit_flags: string[];
            /**
             * Readings
             * @description The inputs of the law that are known.
             */
            readings: {
                [key: string]: number | null;
            };
            settings: components["schemas"]["WhySettings"];
            recorded: components["schemas"]["WhyRecorded"] | null;
            /**
             * Differs
             * @description What the unit told otherwise than it is worked out here, by more than rounding: settings that were only on trial are in no configuration, and after a change the unit still remembers what was before.
             */
            differs: components["schemas"]["WhyDiffers"][];
        };
        /** WhyDiffers */
        WhyDiffers: {
            /**
             * Figure
             * @enum {string}
             */
            figure: "fuzzy_gain" | "assist_ratio";
            /** Recorded */
            recorded: number;
            /** Worked Out */
            worked_out: number;
        };
        /**
         * WhyMoment
         * @description `steady`: held for `hold_s`, nobody rode it. `ride`: `t_s` after its start.
         */
        WhyMoment: {
            /**
             * Kind
             * @enum {string}
             */
            kind: "steady" | "ride";
            /** Ride Id */
            ride_id: number | null;
            /** T S */
            t_s: number | null;
            /** Hold S */
            hold_s: number | null;
        };
        /**
         * WhyRecorded
         * @description What the unit itself told at that moment; the motor's torque at its shaft.
         */
        WhyRecorded: {
            /** Fuzzy Gain */
            fuzzy_gain: number | null;
            /** Assist Ratio */
            assist_ratio: number | null;
            /** Motor Torque Demanded Nm */
            motor_torque_demanded_nm: number | null;
        };
        /**
         * WhyRequest
         * @description A steady state: nothing changes but that the torque keeps rising at `torque_rate`.
         *
         *     Tables, modes and limits take the place of the unit's, or of the law's defaults.
         */
        WhyRequest: {
            /** Speed Kmh */
            speed_kmh: number;
            /**
             * Torque Rate
             * @description Below 0 the torque falls.
             * @default 0
             */
            torque_rate: number;
            /**
             * Rider Torque Nm
             * @default 30
             */
            rider_torque_nm: number;
            /**
             * Cadence Rpm
             * @default 60
             */
            cadence_rpm: number;
            /**
             * Mode
             * @description Slot; without it the one at start.
             */
            mode?: number | null;
            /**
             * Motor Speed Rpm
             * @description Without it the motor follows the crank.
             */
            motor_speed_rpm?: number | null;
            /** Battery Voltage V */
            battery_voltage_v?: number | null;
            /** Battery Current A */
            battery_current_a?: number | null;
            /** Motor Temperature Degc */
            motor_temperature_degc?: number | null;
            /** Controller Temperature Degc */
            controller_temperature_degc?: number | null;
            /**
             * Brake
             * @default false
             */
            brake: boolean;
            /**
             * Walk Button
             * @default false
             */
            walk_button: boolean;
            /**
             * Hold S
             * @description For how long, from rest, at 100 steps a second
             * @default 10
             */
            hold_s: number;
            fuzzy_table?: components["schemas"]["FuzzyTable"] | null;
            /** @description Shares speed and torque-rate points with the first. */
            second_table?: components["schemas"]["FuzzyTable"] | null;
            assist_modes?: components["schemas"]["AssistModes"] | null;
            limits?: components["schemas"]["UnitLimits"] | null;
        };
        /**
         * WhySettings
         * @description What the steps after the law go by in this mode.
         */
        WhySettings: {
            /** Gear Ratio */
            gear_ratio: number;
            /** Mode Ratio */
            mode_ratio: number;
            /** Pedal Torque Nm Min */
            pedal_torque_nm_min: number;
            /** Cutoff Kmh */
            cutoff_kmh: number;
            /** Ramp Up Nm Per S */
            ramp_up_nm_per_s: number;
            /** Ramp Down Nm Per S */
            ramp_down_nm_per_s: number;
            /**
             * Motor Torque Nm Max
             * @description The mode's share of it, at the motor's shaft.
             */
            motor_torque_nm_max: number;
            /** Battery Current A Max */
            battery_current_a_max: number;
            /** Battery Voltage V Min */
            battery_voltage_v_min: number;
            /** Motor Speed Rpm Max */
            motor_speed_rpm_max: number;
        };
        /**
         * WhyStep
         * @description What one step of the pipeline added to the torque at the crank, or took from it.
         */
        WhyStep: {
            /** Name */
            name: string;
            /** Torque Nm */
            torque_nm: number;
            /**
             * Power W
             * @description At the crank's speed; null where it is not known.
             */
            power_w: number | null;
            /**
             * Limit
             * @description The limit it is, where it took or gave something.
             */
            limit: string | null;
        };
        /**
         * Worked
         * @description What comes out. With refusals, or too few captures, nothing is fitted: None and empty.
         */
        Worked: {
            /** Refusals */
            refusals: components["schemas"]["Refusal"][];
            fit: components["schemas"]["Fit"] | null;
            curve: components["schemas"]["Curve"] | null;
            piecewise: components["schemas"]["Piecewise"] | null;
            asymmetry: components["schemas"]["Asymmetry"] | null;
            /** Figures */
            figures: components["schemas"]["SideFigures"][];
            /** As Found */
            as_found: components["schemas"]["SideFigures"][];
            /** Zero Return Nm */
            zero_return_nm: number | null;
            budget: components["schemas"]["Budget"] | null;
            /** Verifications */
            verifications: components["schemas"]["Verification"][];
            judgement: components["schemas"]["Judgement"];
        };
        /**
         * Problem
         * @description Why a request was refused, what is at fault, and what to do about it.
         */
        Problem: {
            /**
             * Type
             * @description Stable name of the kind of problem: `urn:spindle:` and the code.
             */
            type: string;
            /** Title */
            title: string;
            /** Status */
            status: number;
            /** Detail */
            detail: string;
            /** Code */
            code: string;
            /** Errors */
            errors: components["schemas"]["FieldProblem"][];
            /**
             * @description Only with the code `token_needed`.
             * @default null
             */
            challenge: components["schemas"]["TokenChallenge"] | null;
            /**
             * Outcome
             * @description With 504 of a change: whether the unit has it, as far as could be found out.
             * @default null
             */
            outcome: ("unchanged" | "changed" | "unknown") | null;
        };
        /**
         * FieldProblem
         * @description One field at fault.
         */
        FieldProblem: {
            /** Field */
            field: string;
            /** Code */
            code: string;
            /** Message */
            message: string;
        };
        /**
         * TokenChallenge
         * @description What a maker signs with `spindle unlock sign`; bytes in hex.
         */
        TokenChallenge: {
            /** Uid */
            uid: string;
            /** Nonce */
            nonce: string;
            /** Level */
            level: string;
            /** Ttl S */
            ttl_s: number;
            /**
             * Expires Us
             * @description Of the unit's clock.
             */
            expires_us: number;
            /**
             * Image
             * @description The whole configuration that is to become active.
             */
            image: string;
            /**
             * Image Sha512
             * @description What of the image goes under the signature.
             */
            image_sha512: string;
        };
    };
    responses: never;
    parameters: never;
    requestBodies: never;
    headers: never;
    pathItems: never;
}
export type $defs = Record<string, never>;
export interface operations {
    get_health: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Health"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_addresses: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Addresses"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_store: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["StorePlace"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_backup: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/zip": unknown;
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_session: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Session"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    sign_out: {
        parameters: {
            query?: {
                /** @description All of this person's browsers. */
                everywhere?: boolean;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    sign_in: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["SignInRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Person"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too Many Requests */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    make_first_person: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["FirstPerson"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Person"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too Many Requests */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    change_own_password: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["OwnPassword"];
            };
        };
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too Many Requests */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    give_ticket: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Ticket"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_people: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["People"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    add_person: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["PersonIn"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Person"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too Many Requests */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    remove_person: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                person_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    change_person: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                person_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["PersonChange"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Person"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too Many Requests */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_keys: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ApiKeys"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    add_key: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ApiKeyIn"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["NewApiKey"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    revoke_key: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                key_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_passkeys: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Passkeys"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    add_passkey: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["PasskeyIn"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Passkey"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    begin_passkey: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["OwnPasswordOnly"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["NewPasskeyChallenge"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too Many Requests */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    remove_passkey: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                passkey_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    begin_passkey_sign_in: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PasskeyChallenge"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    sign_in_with_passkey: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["PasskeyProof"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Person"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too Many Requests */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_audit: {
        parameters: {
            query?: {
                limit?: number;
                cursor?: string | null;
                /** @description Part of a name, of a person or a key. */
                who?: string | null;
                action?: components["schemas"]["Action"] | null;
                object_kind?: ("account" | "key" | "bike" | "unit" | "configuration" | "calibration" | "visit" | "ride" | "upload" | "table" | "library_item" | "store") | null;
                unit_key?: string | null;
                bike_id?: number | null;
                from?: string | null;
                to?: string | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AuditPage"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    export_audit: {
        parameters: {
            query?: {
                format?: "csv" | "jsonl";
                /** @description Part of a name, of a person or a key. */
                who?: string | null;
                action?: components["schemas"]["Action"] | null;
                object_kind?: ("account" | "key" | "bike" | "unit" | "configuration" | "calibration" | "visit" | "ride" | "upload" | "table" | "library_item" | "store") | null;
                unit_key?: string | null;
                bike_id?: number | null;
                from?: string | null;
                to?: string | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/csv": unknown;
                    "application/jsonl": unknown;
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_bikes: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Bikes"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    add_bike: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["BikeIn"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["BikeDetail"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_bike: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                bike_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["BikeDetail"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    remove_bike: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                bike_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    change_bike: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                bike_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["BikeChange"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["BikeDetail"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    give_rides: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                bike_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["BikeGift"];
            };
        };
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    pair_bike: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                bike_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["PairingIn"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Pairing"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    leave_bike: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                bike_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_pairing: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                code: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Offer"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too Many Requests */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    take_pairing: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                code: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["BikeDetail"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too Many Requests */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    join_by_pairing: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                code: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["NewRider"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Joined"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too Many Requests */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    check_unit: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["UnitChecks"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_support_file: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SupportFile"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_visits: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                bike_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["VisitList"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    open_visit: {
        parameters: {
            query?: never;
            header?: {
                /** @description Whose change this is, percent-encoded UTF-8; without it that of the server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key is the author, whatever this says. */
                "spindle-author"?: string | null;
            };
            path: {
                bike_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["VisitIn"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Visit"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_visit: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                visit_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Visit"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    remove_visit: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                visit_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    change_visit: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                visit_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["VisitChangeIn"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Visit"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    look_at_unit: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                visit_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["VisitReadingsIn"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Visit"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    close_visit: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                visit_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Visit"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    consent_to_visit: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                visit_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["VisitConsentIn"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Visit"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    add_visit_photo: {
        parameters: {
            query: {
                /** @description Of the file. */
                name: string;
            };
            header?: never;
            path: {
                visit_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "image/jpeg": string;
                "image/png": string;
                "image/webp": string;
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Visit"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_visit_photo: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                visit_id: number;
                sha256: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "image/jpeg": unknown;
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    remove_visit_photo: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                visit_id: number;
                sha256: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Visit"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_bike_history: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                bike_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/zip": unknown;
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    add_bike_history: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                bike_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/zip": string;
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HistoryAdded"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    evaluate_calibration: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["EvaluationRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Evaluation"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    since_revision: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
                seq: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SinceChange"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_ports: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PortList"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_devices: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["DeviceList"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    add_device: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["DeviceRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Device"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_device: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Device"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    remove_device: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_snapshot: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Snapshot"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_service: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["WearCounters"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_dashboard: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Dashboard"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_faults: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["FaultList"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    clear_faults: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["FaultList"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_scenarios: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ScenarioList"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_simulation: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Simulation"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    put_simulation: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["SimulationChange"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Simulation"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    advance_simulation: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["SimulationAdvance"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Simulation"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    moment_of_fault: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                device_id: string;
                fault_name: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["FaultMoment"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    mark_moment: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RideMark"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_logs: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["UnitLogs"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    erase_log: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
                log_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ErasedLog"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_log_download: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
                log_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LogDownload"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    start_log_download: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
                log_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            202: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LogDownload"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_parameters: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ParameterList"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_config: {
        parameters: {
            query?: {
                /** @description Of the unit: what is in force, what was before, what its firmware brings. */
                bank?: "active" | "previous" | "default";
            };
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Config"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    patch_config: {
        parameters: {
            query?: never;
            header?: {
                /** @description The ETag of the configuration the change was made for, several, or `*`. */
                "if-match"?: string | null;
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
                /** @description Whose change this is, percent-encoded UTF-8; without it that of the server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key is the author, whatever this says. */
                "spindle-author"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ConfigPatch"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ConfigChange"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_last_known: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LastKnown"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    confirm_config: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
                /** @description Whose change this is, percent-encoded UTF-8; without it that of the server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key is the author, whatever this says. */
                "spindle-author"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ConfigChange"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    rollback_config: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
                /** @description Whose change this is, percent-encoded UTF-8; without it that of the server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key is the author, whatever this says. */
                "spindle-author"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ConfigChange"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_revisions: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RevisionList"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    why_of_device: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["WhyRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Why"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_trial_values: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TrialValues"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    set_trial_values: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["TrialValuesRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TrialValues"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    end_trial_values: {
        parameters: {
            query?: never;
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TrialValues"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_part: {
        parameters: {
            query?: {
                /** @description Which of the unit's two tables; a mode names the one it uses so, too. */
                table?: "first" | "second";
            };
            header?: {
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
            };
            path: {
                device_id: string;
                part: "fuzzy_table" | "assist_modes" | "calibration" | "limits";
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["FuzzyTable"] | components["schemas"]["AssistModes"] | components["schemas"]["Calibration"] | components["schemas"]["UnitLimits"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    put_part: {
        parameters: {
            query?: {
                /** @description Why; kept with the revision for later readers. */
                reason?: string;
                /** @description 0 commits for good; else the unit returns to what it had after so many seconds, at a restart or power loss, unless `POST .../config/confirm` comes first. */
                confirm_s?: number;
                /** @description Which of the unit's two tables; a mode names the one it uses so, too. */
                table?: "first" | "second";
                /** @description The maker's answer to the `challenge` of a refusal `token_needed`. */
                token?: string | null;
            };
            header?: {
                /** @description The ETag of the configuration the change was made for, several, or `*`. */
                "if-match"?: string | null;
                /** @description The `unit_key` of the unit the request is for, percent-encoded UTF-8. At another one the answer is 412 `other_unit`, and nothing is changed. */
                "spindle-unit"?: string | null;
                /** @description Whose change this is, percent-encoded UTF-8; without it that of the server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key is the author, whatever this says. */
                "spindle-author"?: string | null;
            };
            path: {
                device_id: string;
                part: "fuzzy_table" | "assist_modes" | "calibration" | "limits";
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["FuzzyTable"] | components["schemas"]["AssistModes"] | components["schemas"]["Calibration"] | components["schemas"]["UnitLimits"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ConfigChange"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_calibrations: {
        parameters: {
            query?: {
                unit_key?: string | null;
                bike_id?: number | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["JobList"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    open_calibration: {
        parameters: {
            query?: never;
            header?: {
                /** @description Whose change this is, percent-encoded UTF-8; without it that of the server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key is the author, whatever this says. */
                "spindle-author"?: string | null;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["JobRequest"];
            };
        };
        responses: {
            /** @description The one that is open already */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_calibration_job: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                calibration_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_calibration_reading: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                calibration_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Reading"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    set_up_calibration: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                calibration_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["SetupRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    capture: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                calibration_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["CaptureRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    strike_capture: {
        parameters: {
            query?: {
                /** @description Why; kept. */
                reason?: string;
            };
            header?: {
                /** @description Whose change this is, percent-encoded UTF-8; without it that of the server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key is the author, whatever this says. */
                "spindle-author"?: string | null;
            };
            path: {
                calibration_id: number;
                number: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    fit_calibration: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                calibration_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    write_calibration: {
        parameters: {
            query?: {
                /** @description Why; kept. */
                reason?: string;
                /** @description The maker's answer to the `challenge` of a refusal `token_needed`. */
                token?: string | null;
            };
            header?: {
                /** @description Whose change this is, percent-encoded UTF-8; without it that of the server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key is the author, whatever this says. */
                "spindle-author"?: string | null;
            };
            path: {
                calibration_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    verify_calibration: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                calibration_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["VerifyRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    restore_calibration: {
        parameters: {
            query?: {
                /** @description Why; kept. */
                reason?: string;
                /** @description The maker's answer to the `challenge` of a refusal `token_needed`. */
                token?: string | null;
            };
            header?: {
                /** @description Whose change this is, percent-encoded UTF-8; without it that of the server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key is the author, whatever this says. */
                "spindle-author"?: string | null;
            };
            path: {
                calibration_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    close_calibration: {
        parameters: {
            query?: never;
            header?: {
                /** @description Whose change this is, percent-encoded UTF-8; without it that of the server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key is the author, whatever this says. */
                "spindle-author"?: string | null;
            };
            path: {
                calibration_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Job"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_calibration_certificate: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                calibration_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["CertificateFile"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_calibration_certificate_pdf: {
        parameters: {
            query?: {
                language?: "en" | "zh";
                /** @description Of all moments; IANA name. */
                zone?: string;
                paper?: "a4" | "letter";
            };
            header?: never;
            path: {
                calibration_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/pdf": unknown;
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    roll_out_wheel: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["RollOut"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Wheel"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    track_wheel: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["WheelByTrack"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Wheel"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    count_wheel_pulses: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["PulsesRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PulseComparison"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    check_cadence: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["CadenceRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Cadence"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    check_by_climb: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ClimbRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ClimbResult"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    sensor_drift: {
        parameters: {
            query?: {
                /** @description How many are listed; the trend is of all. */
                rides?: number;
            };
            header?: never;
            path: {
                device_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SensorDrift"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    compute_surface: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["SurfaceRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Surface"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    compute_points: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["PointsRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PointGains"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    compute_torque_surface: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["TorqueSurfaceRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TorqueSurface"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    compute_mode_curves: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ModeCurvesRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ModeCurves"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    lint_table: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["LintRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LintReport"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    prove_limits: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["LimitProofRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LimitProof"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    why_steady: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["WhyRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Why"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_library: {
        parameters: {
            query?: {
                /** @description Deleted own items, too. */
                deleted?: boolean;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LibraryList"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    add_library_item: {
        parameters: {
            query?: never;
            header?: {
                /** @description Whose change this is, percent-encoded UTF-8; without it that of the server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key is the author, whatever this says. */
                "spindle-author"?: string | null;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["LibraryDocument"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LibraryRow"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    compare: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["CompareRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Comparison"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Gateway Timeout */
            504: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    read_fis: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["FisText"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ReadFis"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_library_entry: {
        parameters: {
            query?: {
                /** @description Of an own item: as it was in this version. */
                version?: number | null;
            };
            header?: never;
            path: {
                entry_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LibraryEntry"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    change_library_item: {
        parameters: {
            query?: never;
            header?: {
                /** @description The ETag of what the change was made for, or `*`. */
                "if-match"?: string | null;
                /** @description Whose change this is, percent-encoded UTF-8; without it that of the server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key is the author, whatever this says. */
                "spindle-author"?: string | null;
            };
            path: {
                entry_id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["LibraryDocument"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LibraryRow"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    remove_library_item: {
        parameters: {
            query?: never;
            header?: {
                /** @description The ETag of what the change was made for, or `*`. */
                "if-match"?: string | null;
                /** @description Whose change this is, percent-encoded UTF-8; without it that of the server's setting `author`. It is kept, marked `stated`. Who signed in or sends a key is the author, whatever this says. */
                "spindle-author"?: string | null;
            };
            path: {
                entry_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LibraryRow"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    export_library_entry: {
        parameters: {
            query?: {
                format?: "json" | "fis" | "csv";
                /** @description Of a configuration, for `fis` and `csv`. */
                table?: "first" | "second";
                /** @description Of an own item: as it was in this version. */
                version?: number | null;
            };
            header?: never;
            path: {
                entry_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/octet-stream": unknown;
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_library_feel: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                entry_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Feel"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_library_versions: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                entry_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LibraryList"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    rider_home: {
        parameters: {
            query?: {
                /** @description The rider's time zone, of the IANA database. */
                zone?: string;
                /** @description 1 Monday to 7 Sunday. */
                week_begins?: number;
                bike?: number | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RiderHome"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    export_rides: {
        parameters: {
            query?: {
                formats?: ("csv" | "parquet" | "fit" | "gpx" | "original")[];
                /** @description Numbers of rides separated by commas; absent means all of this kind. */
                ids?: string | null;
                /** @description To be shown to strangers: what is so near to the ride's start and end, in m, is left out, later passes too, and distance and time begin behind it. FIT, GPX and CSV; 422 `no_positions`, `nothing_to_share`. */
                blur_m?: number | null;
                bike?: number | null;
                /** @description At least so far. */
                longer_km?: number | null;
                /** @description The motor's energy is known. */
                motor?: boolean;
                /** @description With faults or marks. */
                events?: boolean;
                tag?: string | null;
                /** @description Words, all in name, notes, tags or place. */
                q?: string | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/zip": unknown;
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    tag_rides: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["RideTags"];
            };
        };
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    delete_rides: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["RidesGone"];
            };
        };
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    compare_rides: {
        parameters: {
            query: {
                a: number;
                b: number;
                /** @description Since that ride's start. */
                a_from_s?: number | null;
                /** @description Since that ride's start. */
                a_to_s?: number | null;
                /** @description Since that ride's start. */
                b_from_s?: number | null;
                /** @description Since that ride's start. */
                b_to_s?: number | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RideComparison"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    compare_ride_series: {
        parameters: {
            query: {
                /** @description The common axis. */
                by?: "time" | "distance";
                /** @description Names separated by commas; absent means all of them. */
                channels?: string | null;
                /** @description Of the axis: s or m. */
                from_x?: number;
                to_x?: number | null;
                /** @description Bins. */
                px?: number;
                a: number;
                b: number;
                /** @description Since that ride's start. */
                a_from_s?: number | null;
                /** @description Since that ride's start. */
                a_to_s?: number | null;
                /** @description Since that ride's start. */
                b_from_s?: number | null;
                /** @description Since that ride's start. */
                b_to_s?: number | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ComparedSeries"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    compare_ride_crank: {
        parameters: {
            query: {
                a: number;
                b: number;
                /** @description Since that ride's start. */
                a_from_s?: number | null;
                /** @description Since that ride's start. */
                a_to_s?: number | null;
                /** @description Since that ride's start. */
                b_from_s?: number | null;
                /** @description Since that ride's start. */
                b_to_s?: number | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ComparedCrank"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    energy_of_ride: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RideEnergy"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    effort_of_ride: {
        parameters: {
            query?: {
                /** @description What the rider can hold for an hour. */
                threshold_power_w?: number | null;
                /** @description The rider's. */
                heart_rate_bpm_max?: number | null;
            };
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RideEffort"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    pedalling_of_ride: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RidePedalling"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    diagnosis_of_ride: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RideDiagnosis"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    report_of_ride: {
        parameters: {
            query?: {
                language?: "en" | "zh";
                /** @description What the rider can hold for an hour. */
                threshold_power_w?: number | null;
                /** @description The rider's. */
                heart_rate_bpm_max?: number | null;
            };
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/html": unknown;
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_rides: {
        parameters: {
            query?: {
                from?: string | null;
                to?: string | null;
                /** @description A unit's key or serial number, or a device's id. */
                device?: string | null;
                limit?: number;
                cursor?: string | null;
                bike?: number | null;
                /** @description At least so far. */
                longer_km?: number | null;
                /** @description The motor's energy is known. */
                motor?: boolean;
                /** @description With faults or marks. */
                events?: boolean;
                tag?: string | null;
                /** @description Words, all in name, notes, tags or place. */
                q?: string | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RideList"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_ride: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Ride"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    delete_ride: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    patch_ride: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["RidePatch"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Ride"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_ride_series: {
        parameters: {
            query?: {
                /** @description Names separated by commas; absent means all of them. */
                channels?: string | null;
                from_s?: number | null;
                to_s?: number | null;
                /** @description Width of the plot. */
                px?: number;
                /** @description What the plot's pixels are equal parts of. */
                axis?: "time" | "moving" | "distance";
            };
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Series"];
                    "application/octet-stream": unknown;
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_ride_track: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Track"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_ride_figure: {
        parameters: {
            query?: {
                /** @description Names separated by commas; absent means all of them. */
                channels?: string | null;
                px?: number;
                language?: "en" | "zh";
            };
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Figure"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    export_ride: {
        parameters: {
            query?: {
                format?: "csv" | "parquet" | "fit" | "gpx" | "original";
                /** @description To be shown to strangers: what is so near to the ride's start and end, in m, is left out, later passes too, and distance and time begin behind it. FIT, GPX and CSV; 422 `no_positions`, `nothing_to_share`. */
                blur_m?: number | null;
            };
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/csv": unknown;
                    "application/vnd.apache.parquet": unknown;
                    "application/vnd.ant.fit": unknown;
                    "application/gpx+xml": unknown;
                    "application/octet-stream": unknown;
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    replay_ride: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ReplayRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Replay"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    ride_again: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["AgainRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ClosedLoop"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    why_of_ride: {
        parameters: {
            query: {
                t_s: number;
            };
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Why"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    cuts_of_ride: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Cuts"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    ledger_of_ride: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                ride_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Ledger"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description `object_damaged`: the ride's file is not as written */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    table_use: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["TableUseRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TableUse"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    propose: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ProposalRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            202: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Proposal"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_proposal: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                proposal_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Proposal"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    cancel_proposal: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                proposal_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Proposal"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    import_ride: {
        parameters: {
            query: {
                /** @description The file's own name. */
                name: string;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Upload"];
                };
            };
            /** @description Bad Request */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Request Entity Too Large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    sample_ride: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Ride"];
                };
            };
            /** @description Bad Request */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Request Entity Too Large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_uploads: {
        parameters: {
            query?: {
                limit?: number;
                cursor?: string | null;
                part_of?: string | null;
                sha256?: string | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["UploadList"];
                };
            };
            /** @description Bad Request */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Request Entity Too Large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    create_upload: {
        parameters: {
            query?: never;
            header: {
                "upload-length": number;
                "upload-metadata"?: string;
                /** @description Of the part in this request's body. */
                "upload-checksum"?: string | null;
                "tus-resumable"?: string;
            };
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    /** @description Of the upload; its parts are sent there. */
                    Location?: string;
                    /** @description Bytes that have arrived. */
                    "Upload-Offset"?: number;
                    /** @description Until when an unfinished upload is waited for. */
                    "Upload-Expires"?: string;
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Bad Request */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Request Entity Too Large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The part has not the digest it was sent with. */
            460: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    describe_uploads: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Bad Request */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Request Entity Too Large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_upload: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                upload_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Upload"];
                };
            };
            /** @description Bad Request */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Request Entity Too Large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    delete_upload: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                upload_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Bad Request */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Request Entity Too Large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_upload_offset: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                upload_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    /** @description Bytes of the whole file. */
                    "Upload-Length"?: number;
                    /** @description Bytes that have arrived. */
                    "Upload-Offset"?: number;
                    /** @description Until when an unfinished upload is waited for. */
                    "Upload-Expires"?: string;
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Bad Request */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Request Entity Too Large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    append_upload: {
        parameters: {
            query?: never;
            header: {
                "upload-offset": number;
                /** @description Of the part in this request's body. */
                "upload-checksum"?: string | null;
                "tus-resumable"?: string;
            };
            path: {
                upload_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    /** @description Bytes that have arrived. */
                    "Upload-Offset"?: number;
                    /** @description Until when an unfinished upload is waited for. */
                    "Upload-Expires"?: string;
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Bad Request */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Precondition Failed */
            412: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Request Entity Too Large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unsupported Media Type */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The part has not the digest it was sent with. */
            460: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    get_mapping: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                upload_id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TableQuestion"];
                };
            };
            /** @description Bad Request */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    put_mapping: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                upload_id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["TableAnswerRequest"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Upload"];
                };
            };
            /** @description The body is not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_tables: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AnsweredTables"];
                };
            };
            /** @description Bad Request */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    forget_table: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                header_sha256: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Bad Request */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unauthorized */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Forbidden */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not Found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Conflict */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unprocessable Entity */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_healthz: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Alive"];
                };
            };
        };
    };
    get_readyz: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Alive"];
                };
            };
            /** @description Service Unavailable */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
}
