# %% name="no transposition" sentence="The second F is transposed: F @ covariance @ F.T." must_say=["F\\.T"] must_not_say=["value by value"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance @ F + Q

# %% name="state only" sentence="Return the covariance as well." must_say=["covariance|two|both"] kind="shape"
def predict(state, covariance, F, Q):
    return F @ state

# %% name="no return" sentence="The function returns nothing: add return." must_say=["return"] kind="no-return"
def predict(state, covariance, F, Q):
    state = F @ state
    covariance = F @ covariance @ F.T + Q

# %% name="rounded" sentence="Return the exact numbers: leave round out." must_say=["round|exact"] kind="value"
def predict(state, covariance, F, Q):
    return (F @ state).round(2), (F @ covariance @ F.T + Q).round(2)
