(** * Linear pre-integration has order 2

    Claim.  Replace the field s by s_d, linear between its values at the nodes of n
    segments of length d = D/n, and integrate the result exactly.  The radiance is
    then missed by at most

      (K_source D + G K_extinction D^2) M / 8 d^2,

    where M bounds s'', K_extinction and K_source are Lipschitz constants of the
    transfer functions tau and C tau over s, and G bounds C tau.

    Source.  The method: Engel, Kraus and Ertl, "High-Quality Pre-Integrated Volume
    Rendering Using Hardware-Accelerated Pixel Shading" (2001).  The bound is the
    textbook error of linear interpolation, sent through the integral.

    Assumptions.  s has two derivatives on [0, D]; s and s_d are continued beyond
    the ray's ends without a jump; tau is not negative, and tau and C tau are
    Lipschitz continuous, so that they may have kinks.

    Not modelled.  How the segments of s_d are integrated: a table's resolution, a
    quadrature that fills it, a neglected attenuation inside a segment, or colour
    and opacity from different interpolants.  Nor other interpolants than the linear.
    Not claimed: that the constant is the best one, or that the order is no higher.

    The program expects order 2 of what a linear interpolant leaves in the radiance. *)

From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Volver Require Import Integral Derivatives TaylorRule Order LinearExponential.
Open Scope R_scope.

(** The error of linear interpolation. *)
Lemma linear_interpolation_error (f : nat -> R -> R) (a h x M : R) :
  0 <= h -> 0 <= x <= 1 -> derivatives 2 f a (a + h) ->
  (forall l, a <= l <= a + h -> Rabs (f 2%nat l) <= M) ->
  Rabs (f 0%nat (a + x * h) - ((1 - x) * f 0%nat a + x * f 0%nat (a + h))) <= M / 8 * h ^ 2.
Proof.
  intros Hh Hx Hf HM. set (m := a + x * h).
  (* Taylor's theorem about m, at either end *)
  assert (remainder : forall s u, Rabs s = 1 -> 0 <= u ->
    (forall v, 0 <= v <= u -> a <= m + s * v <= a + h) ->
    Rabs (f 0%nat (m + s * u) - taylor 2 f m (s * u)) <= M * taylor_term 2 u).
  { intros s u Hs Hu inside. apply taylor_remainder_one_side; [easy | easy | |].
    - intros k v Hk Hv. apply Hf; [easy | now apply inside].
    - intros v Hv. now apply HM, inside. }
  assert (0 <= x * h <= h) by (split; nra).
  assert (front := remainder (-1) (x * h) ltac:(rewrite Rabs_left; lra) ltac:(lra)
    ltac:(intros v Hv; unfold m; lra)).
  assert (back := remainder 1 ((1 - x) * h) ltac:(apply Rabs_R1) ltac:(lra)
    ltac:(intros v Hv; unfold m; lra)).
  replace (m + -1 * (x * h)) with a in front by (unfold m; ring).
  replace (m + 1 * ((1 - x) * h)) with (a + h) in back by (unfold m; ring).
  unfold taylor, taylor_term in front, back. simpl in front, back.
  apply Rabs_le_between in front, back.
  assert (M_pos : 0 <= M) by (eapply Rle_trans; [apply Rabs_pos | apply (HM a); lra]).
  assert (parabola : M / 2 * h ^ 2 * (x * (1 - x)) <= M / 2 * h ^ 2 * (1 / 4)).
  { apply Rmult_le_compat_l; [apply Rmult_le_pos; [lra | apply pow2_ge_0] |].
    assert (0 <= (x - 1/2) ^ 2) by apply pow2_ge_0. lra. }
  assert (front' := Rmult_le_compat_l (1 - x) _ _ ltac:(lra) (proj1 front)).
  assert (front'' := Rmult_le_compat_l (1 - x) _ _ ltac:(lra) (proj2 front)).
  assert (back' := Rmult_le_compat_l x _ _ ltac:(lra) (proj1 back)).
  assert (back'' := Rmult_le_compat_l x _ _ ltac:(lra) (proj2 back)).
  apply Rabs_le. unfold Rdiv in *. split; lra.
Qed.

(** What a change of the medium does to the radiance. *)
Section Perturbation.
Variables field field' extinction emission : R -> R.
Variables D G e_extinction e_source : R.
Let sigma := extinction_along field extinction.
Let sigma' := extinction_along field' extinction.
Let c := source field extinction emission.
Let c' := source field' extinction emission.

Hypothesis some_length : 0 <= D.
Hypothesis absorbing : forall s, 0 <= extinction s.
Hypothesis sigma_continuous : forall l, continuous sigma l.
Hypothesis sigma'_continuous : forall l, continuous sigma' l.
Hypothesis c_continuous : forall l, continuous c l.
Hypothesis c'_continuous : forall l, continuous c' l.
Hypothesis extinction_close : forall l, 0 <= l <= D -> Rabs (sigma l - sigma' l) <= e_extinction.
Hypothesis source_close : forall l, 0 <= l <= D -> Rabs (c l - c' l) <= e_source.
Hypothesis source_bounded : forall l, 0 <= l <= D -> Rabs (c l) <= G.

Lemma continuous_integrable (g : R -> R) (a b : R) : (forall l, continuous g l) -> ex_RInt g a b.
Proof. intros Hg. now apply (ex_RInt_continuous (V := R_CompleteNormedModule)). Qed.

Lemma integrand_continuous (s g : R -> R) (l : R) :
  (forall x, continuous s x) -> (forall x, continuous g x) ->
  continuous (fun x => g x * exp (- RInt s 0 x)) l.
Proof.
  intros Hs Hg. apply (continuous_mult g); [apply Hg |].
  apply continuous_exp_opp with (s l).
  apply (is_derive_RInt (V := R_NormedModule)) with (a := 0); [| apply Hs].
  apply filter_forall. intros y. apply (RInt_correct (V := R_CompleteNormedModule)).
  now apply continuous_integrable.
Qed.

Lemma radiance_perturbation :
  Rabs (radiance field extinction emission D - radiance field' extinction emission D)
    <= D * (e_source + G * (D * e_extinction)).
Proof.
  assert (integrals : forall g g', (forall l, continuous g l) -> (forall l, continuous g' l) ->
    forall b e, 0 <= b -> (forall l, 0 <= l <= b -> Rabs (g l - g' l) <= e) ->
    Rabs (RInt g 0 b - RInt g' 0 b) <= b * e).
  { intros g g' Hg Hg' b e Hb He.
    assert (difference := RInt_minus (V := R_CompleteNormedModule) g g' 0 b
      (continuous_integrable g 0 b Hg) (continuous_integrable g' 0 b Hg')).
    change (RInt g 0 b - RInt g' 0 b) with (minus (RInt g 0 b) (RInt g' 0 b)).
    rewrite <- difference. rewrite <- (Rminus_0_r b) at 2.
    apply abs_RInt_le_const; [easy | | exact He].
    apply (ex_RInt_minus (V := R_NormedModule)); now apply continuous_integrable. }
  assert (depth_pos : forall s l, (forall x, continuous s x) -> (forall x, 0 <= s x) ->
    0 <= l -> 0 <= RInt s 0 l).
  { intros s l Hs Hpos Hl. apply RInt_ge_0; [easy | now apply continuous_integrable |]. auto. }
  apply integrals; [intros l; now apply integrand_continuous .. | easy |]. intros l Hl.
  unfold integrand, transmittance, optical_depth.
  fold sigma sigma' c c'. set (t := RInt sigma 0 l). set (t' := RInt sigma' 0 l).
  assert (t_pos : 0 <= t) by (apply depth_pos; [easy | intros x; apply absorbing | lra]).
  assert (t'_pos : 0 <= t') by (apply depth_pos; [easy | intros x; apply absorbing | lra]).
  assert (depths : Rabs (t - t') <= D * e_extinction).
  { eapply Rle_trans; [apply integrals with (e := e_extinction); [easy | easy | lra |] |].
    - intros x Hx. apply extinction_close. lra.
    - apply Rmult_le_compat_r; [| lra].
      eapply Rle_trans; [apply Rabs_pos | apply (extinction_close 0); lra]. }
  assert (transmittances : Rabs (exp (- t) - exp (- t')) <= D * e_extinction).
  { eapply Rle_trans; [apply (transmittance_lipschitz 0); lra |]. now rewrite exp_0, Rmult_1_l. }
  destruct (exp_opp_within t' t'_pos) as [T'_pos T'_one].
  replace (c l * exp (- t) - c' l * exp (- t'))
    with ((c l - c' l) * exp (- t') + c l * (exp (- t) - exp (- t'))) by ring.
  eapply Rle_trans; [apply Rabs_triang |]. rewrite !Rabs_mult, (Rabs_pos_eq (exp (- t'))) by lra.
  apply Rplus_le_compat.
  - rewrite <- (Rmult_1_r e_source). apply Rmult_le_compat; try apply Rabs_pos; auto; lra.
  - apply Rmult_le_compat; try apply Rabs_pos; auto.
Qed.
End Perturbation.

(** [g] is linear between the values of [f] at the ends of each of n segments. *)
Definition interpolates_linearly (n : nat) (d : R) (f g : R -> R) : Prop :=
  forall j x, (j < n)%nat -> 0 <= x <= 1 ->
  g (INR j * d + x * d) = (1 - x) * f (INR j * d) + x * f (INR j * d + d).

Definition lipschitz (K : R) (f : R -> R) : Prop :=
  forall u v, Rabs (f u - f v) <= K * Rabs (u - v).

Lemma lipschitz_continuous (K : R) (f g : R -> R) (l : R) :
  lipschitz K f -> continuous g l -> continuous (fun x => f (g x)) l.
Proof.
  intros Hf Hg. apply continuous_comp; [exact Hg |].
  apply continuity_pt_filterlim. intros e He.
  assert (K_pos : 0 < Rabs K + 1) by (assert (0 <= Rabs K) by apply Rabs_pos; lra).
  exists (e / (Rabs K + 1)). split; [now apply Rdiv_lt_0_compat |]. intros y [_ Hy].
  simpl in *. unfold R_dist in *. eapply Rle_lt_trans; [apply Hf |].
  apply Rle_lt_trans with ((Rabs K + 1) * Rabs (y - g l)).
  - apply Rmult_le_compat_r; [apply Rabs_pos |]. assert (K <= Rabs K) by apply Rle_abs. lra.
  - apply Rmult_lt_reg_r with (/ (Rabs K + 1)); [now apply Rinv_0_lt_compat |].
    replace ((Rabs K + 1) * Rabs (y - g l) * / (Rabs K + 1)) with (Rabs (y - g l)); [exact Hy |].
    field. lra.
Qed.

(** Every point of the ray lies on a segment. *)
Lemma on_a_segment (n : nat) (d l : R) :
  0 <= d -> 0 <= l <= INR (S n) * d ->
  exists j x, (j < S n)%nat /\ 0 <= x <= 1 /\ l = INR j * d + x * d.
Proof.
  intros Hd. induction n as [| n IH]; intros Hl.
  - exists 0%nat. destruct Hd as [Hd | <-].
    + exists (l / d). simpl in *. repeat split; [lia | apply Rdiv_le_0_compat; lra | |].
      * apply Rle_div_l; lra.
      * field. lra.
    + exists 0. simpl in *. repeat split; (lia || lra).
  - destruct (Rle_dec l (INR (S n) * d)) as [before | after].
    + destruct IH as [j [x [Hj Hx]]]; [lra |]. exists j, x. split; [lia | easy].
    + exists (S n), ((l - INR (S n) * d) / d). rewrite (S_INR (S n)) in Hl.
      assert (0 < d) by lra. repeat split; [lia | apply Rdiv_le_0_compat; lra | |].
      * apply Rle_div_l; lra.
      * field. lra.
Qed.

Theorem preintegration_second_order (s : nat -> R -> R) (s_d extinction emission : R -> R)
    (D M G K_extinction K_source : R) (n : nat) :
  let d := D / INR n in
  0 < D -> (0 < n)%nat ->
  derivatives 2 s 0 D -> (forall l, 0 <= l <= D -> Rabs (s 2%nat l) <= M) ->
  (forall l, continuous (s 0%nat) l) -> (forall l, continuous s_d l) ->
  interpolates_linearly n d (s 0%nat) s_d ->
  (forall v, 0 <= extinction v) ->
  lipschitz K_extinction extinction -> lipschitz K_source (fun v => emission v * extinction v) ->
  (forall l, 0 <= l <= D -> Rabs (source (s 0%nat) extinction emission l) <= G) ->
  Rabs (radiance (s 0%nat) extinction emission D - radiance s_d extinction emission D)
    <= (K_source * D + G * K_extinction * D ^ 2) * M / 8 * d ^ 2.
Proof.
  intros d HD Hn Hs HM s_continuous s_d_continuous interpolates absorbing
    extinction_lipschitz source_lipschitz HG.
  assert (Hd := segment_length D n HD Hn). fold d in Hd.
  assert (length : INR n * d = D) by (unfold d; field; now apply not_0_INR, Nat.neq_0_lt_0).
  assert (close : forall l, 0 <= l <= D -> Rabs (s 0%nat l - s_d l) <= M / 8 * d ^ 2).
  { intros l Hl. destruct n as [| k]; [easy |].
    destruct (on_a_segment k d l) as [j [x [Hj [Hx ->]]]]; [lra | now rewrite length |].
    assert (0 <= INR j * d) by (apply Rmult_le_pos; [apply pos_INR | lra]).
    assert (INR j * d + d <= D).
    { rewrite <- length. assert (INR (S j) <= INR (S k)) by (apply le_INR; lia).
      replace (INR j * d + d) with (INR (S j) * d) by (rewrite S_INR; ring).
      apply Rmult_le_compat_r; lra. }
    rewrite interpolates by easy. apply linear_interpolation_error; [lra | easy | |].
    - apply derivatives_within with 0 D; [easy | lra | lra].
    - intros y Hy. apply HM. lra. }
  assert (nonnegative : forall K f, lipschitz K f -> 0 <= K).
  { intros K f Hf. assert (H := Hf 1 0). rewrite Rminus_0_r, Rabs_R1, Rmult_1_r in H.
    eapply Rle_trans; [apply Rabs_pos | exact H]. }
  replace (_ * M / 8 * d ^ 2) with
    (D * (K_source * (M / 8 * d ^ 2) + G * (D * (K_extinction * (M / 8 * d ^ 2))))) by field.
  apply radiance_perturbation; try easy; try lra.
  - intros l. now apply (lipschitz_continuous K_extinction extinction).
  - intros l. now apply (lipschitz_continuous K_extinction extinction).
  - intros l. now apply (lipschitz_continuous K_source (fun v => emission v * extinction v)).
  - intros l. now apply (lipschitz_continuous K_source (fun v => emission v * extinction v)).
  - intros l Hl. eapply Rle_trans; [apply extinction_lipschitz |].
    apply Rmult_le_compat_l; [now apply nonnegative with extinction | now apply close].
  - intros l Hl. eapply Rle_trans; [apply (source_lipschitz (s 0%nat l) (s_d l)) |].
    apply Rmult_le_compat_l; [now apply nonnegative with (1 := source_lipschitz) | now apply close].
Qed.
