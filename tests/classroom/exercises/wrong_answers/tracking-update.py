# %% name="no S" sentence="The gain divides by S: multiply by its inverse." must_say=["S|invers"] kind="value"
def update(state, covariance, measurement, H, R):
    gain = covariance @ H.T
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="state second" sentence="Return the state first." must_say=["first|order"] kind="shape"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return (np.eye(len(state)) - gain @ H) @ covariance, new_state

# %% name="H not transposed" sentence="The second H must be transposed: H.T." must_say=["H\\.T|transpos|match|shape|size"] kind="error"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H + R
    gain = covariance @ H @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="no inverse" sentence="Multiply by the inverse of S." must_say=["invers"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ S
    new_state = state + gain @ (measurement - H @ state)
    return new_state, (np.eye(len(state)) - gain @ H) @ covariance

# %% name="taken away" sentence="Subtract gain @ H @ covariance from the covariance." must_say=["subtract|minus|away"] kind="value"
def update(state, covariance, measurement, H, R):
    S = H @ covariance @ H.T + R
    gain = covariance @ H.T @ np.linalg.inv(S)
    new_state = state + gain @ (measurement - H @ state)
    return new_state, gain @ H @ covariance
