# %% name="no R" origin="new" sentence="Add R in S: the measurement is uncertain too." must_say=["R"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="no inverse" origin="new" sentence="Multiply by the inverse of S." must_say=["invers"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ S
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="no S" origin="new" sentence="The gain divides by S: multiply by its inverse." must_say=["S|invers"] kind="value"
def update(state, covariance, measurement, H, R):
    gain = covariance @ H.T
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="inverse of R" origin="new" sentence="Take the inverse of S, not of R." must_say=["S"] kind="value"
def update(state, covariance, measurement, H, R):
    gain = covariance @ H.T @ np.linalg.inv(R)
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="wrong sign" origin="new" sentence="The difference is the measurement minus H @ state." must_say=["minus|away|difference|sign"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (H @ state - measurement)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="whole measurement" origin="new" sentence="The gain belongs to the difference, not to the measurement." must_say=["difference|minus|H @ state"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ measurement
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="old covariance" origin="new" sentence="A measurement makes the covariance smaller." must_say=["covariance"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return new_state, covariance

# %% name="old state" origin="new" sentence="The state must be corrected too." must_say=["state"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    return state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="plus" origin="new" sentence="np.eye minus gain @ H, not plus." must_say=["minus|larger|plus"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) + gain @ H) @ covariance

# %% name="one" origin="new" sentence="The 1 of matrices is np.eye(n)." must_say=["eye|identity"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (1 - gain @ H) @ covariance

# %% name="taken away" origin="new" sentence="Subtract gain @ H @ covariance from the covariance." must_say=["subtract|minus|away"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return new_state, gain @ H @ covariance

# %% name="order of the product" origin="new" sentence="np.eye - gain @ H stands on the left of the covariance." must_say=["left|order"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return new_state, covariance @ (np.eye(len(state)) - gain @ H)

# %% name="state second" origin="new" sentence="Return the state first." must_say=["first|order"] kind="shape"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return (np.eye(len(state)) - gain @ H) @ covariance, new_state

# %% name="H not transposed" origin="new" sentence="The second H must be transposed: H.T." must_say=["H\\.T|transpos|match|shape|size"] kind="error"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H + R
    gain = covariance @ H @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="divided by S" origin="new" sentence="A matrix cannot be divided by: use np.linalg.inv(S)." must_say=["inv|divid"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T / S[0, 0]
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="without H" origin="new" sentence="The state has more numbers than the measurement: subtract H @ state." must_say=["H|shape|broadcast|match"] kind="error"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="state only" origin="new" sentence="Return the covariance as well." must_say=["covariance|two|both"] kind="shape"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return new_state
